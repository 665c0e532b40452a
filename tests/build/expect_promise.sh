#!/bin/sh
# expect_promise.sh CODE REFERENCE PROGRAM [MODE]: passes if self_check.cpp's PROGRAM ends with CODE, and prints the same
# bits as REFERENCE if that is 0: they were promised. Also if it ends with 77: this machine cannot tell.
set -u

expected=$1
reference=$("$2")
shift 2
bits=$("$@")
code=$?
echo "exit code $code, expected $expected; $bits, of the reference: $reference"
[ "$code" = 77 ] && exit 77
[ "$code" = "$expected" ] || exit 1
[ "$code" != 0 ] || [ "$bits" = "$reference" ]
