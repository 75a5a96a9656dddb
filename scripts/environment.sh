# shellcheck shell=bash
# Sourced by the other scripts: one clean environment, whatever the caller's shell has set up.

set -euo pipefail

package_dir=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
readonly package_dir

# Debian's Python first (another python3 breaks catkin), and no other workspace or master.
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:$PATH
unset CMAKE_PREFIX_PATH PYTHONPATH PYTHONHOME ROS_PACKAGE_PATH ROS_IP ROS_NAMESPACE
export ROS_HOSTNAME=localhost
export ROS_HOME=$package_dir/build/ros_home
export ROS_LOG_DIR=$ROS_HOME/log

say() { printf '\n== %s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Prints the comment at the head of the calling script as its help.
print_help() { sed -n '2,/^$/ s/^# \{0,1\}//p' "$0"; }

# Runs a command whose output matters only if it fails; shows it live on a terminal.
quietly() {
  if [[ -t 1 ]]; then
    "$@"
    return
  fi
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  ((status == 0)) || cat "$log" >&2
  rm -f "$log"
  return "$status"
}

# Sets ROS_MASTER_URI to a free port of this machine, so that a running master is not disturbed.
choose_free_master() {
  local port
  port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("localhost", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://localhost:$port
}

# Sources a catkin setup file, which does not bear `set -u`.
source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}
