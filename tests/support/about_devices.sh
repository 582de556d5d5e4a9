# shellcheck shell=bash
# Which test files are about devices, and so run over several trees (see
# tests/support/tree.pl). Sourced, not run.

about_devices='driver motors sensors robot bad_input threads halt library brick_check'

# is_about_devices FILE
is_about_devices() {
    local name
    name=$(basename "$1" .pl)
    [[ " $about_devices " == *" ${name#test_} "* ]]
}
