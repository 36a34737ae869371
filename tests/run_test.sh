#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run a test's program in the current folder and compare what it prints, by
# deal.II's scripts:
#   run_test.sh SCRIPTS TEST NUMDIFF EXPECTED.output PROGRAM [ARGUMENT...]
set -e
scripts=$1 test=$2 numdiff=$3 expected=$4
shift 4
sh "$scripts/run_test.sh" run "$test" "$@"
perl -pi "$scripts/normalize.pl" output
sh "$scripts/run_test.sh" diff "$test" "$numdiff" "$expected"
