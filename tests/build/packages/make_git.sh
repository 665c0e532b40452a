#!/bin/sh
# make_git.sh SOURCES REPOSITORY: a git repository with what a user's build needs of the sources as they are now,
# committed or not.
set -eu
sources=$1
export GIT_DIR="$2" GIT_WORK_TREE="$sources"
export GIT_AUTHOR_NAME=test GIT_AUTHOR_EMAIL=test@invalid GIT_COMMITTER_NAME=test GIT_COMMITTER_EMAIL=test@invalid
rm -rf "$GIT_DIR"
mkdir -p "$GIT_DIR"
git init --quiet --initial-branch=main
cd "$sources"
git add CMakeLists.txt LICENSE package.xml include
git -c commit.gpgsign=false commit --quiet -m test
