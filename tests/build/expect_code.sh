#!/bin/sh
# expect_code.sh CODE PROGRAM [ARGUMENTS]: passes if the program ends with CODE, or with 77: this machine cannot tell.
expected=$1
shift
"$@"
code=$?
echo "exit code $code, expected $expected"
[ "$code" = "$expected" ] || [ "$code" = 77 ]
