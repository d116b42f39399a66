#!/bin/bash
# Does what users did in the cases of ../shared/cases, and prints one line for each: whether the
# output is what its expect.md wants.
#
#   tests/tools/cells/cases.sh            all cases
#   tests/tools/cells/cases.sh NAME…      these
#
# CASES_DIR names another folder of cases; each case is a folder with a run.sh. The scripts run in
# a scratch copy. The status is 1 where a case is not as expected; its output is then printed.
set -u
here=$(cd "$(dirname "$0")/../../.." && pwd)
cases=${CASES_DIR:-$here/../shared/cases}
[ -d "$cases" ] || { echo "cases.sh: there is no folder $cases; name it by CASES_DIR" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -r "$cases/." "$scratch" && chmod -R u+w "$scratch"
# shellcheck source=/dev/null
source "$here/env.sh"
export ROS_DOMAIN_ID=${ROS_DOMAIN_ID:-143}

# A case is expected to have and to lack lines; $output is what its run.sh printed.
has() { grep -Eq -- "$1" "$output" || { wanted="no line with: $1"; return 1; }; }
lacks() { ! grep -Eq -- "$1" "$output" || { wanted="a line with: $1"; return 1; }; }
counts() { [ "$(grep -Ec -- "$2" "$output")" -eq "$1" ] || { wanted="not $1 lines with: $2"; return 1; }; }

# One function for each case, with its name. It may only use has, lacks and counts.

bag_split() {
  has 'split_0.mcap, split_1.mcap' && has '^/chatter +std_msgs/msg/String +6 +0 ' &&
    has 'unknown.mcap.zstd is compressed; unpack it with `zstd -d' && has 'is a pipe' &&
    lacks 'does not exist|is damaged'
}

bag_types_not_installed() {
  has 'left out /[a-z_/]+: message type [a-zA-Z_/]+ is not installed' &&
    has '^2073 messages on 6 topics replayed' && has '^status 0'
}

push_units_and_signs() {
  has 'deg_theta.csv: .*degrees: divide by 57.3' && has 'cm_dxdy.csv: .*centimetres: divide by 100' &&
    has 'flip_theta.csv: dtheta_rad has the other sign' && has 'flip_py.csv: p_y_m has the other sign' &&
    has 'flip_dy.csv: dy_m has the other sign' && has 'swap_xy.csv: dx_m and dy_m are exchanged' &&
    has 'zeros.csv: the object did not move' && counts 1 '^completed +yes'
}

push_duplicates() {
  has '200 of 400 rows are copies' && counts 2 '^completed +yes'
}

push_csv_forms() {
  counts 7 '^model [0-9a-f]+ written' && has 'noheader.csv, line 1: names no columns'
}

two_commanders() {
  has 'cell: .*/teleop' && lacks '^completed +yes'
}

own_driver() {
  has '^deadline-mm commands received 0' && has '^deadline-zeroq commands received 0' &&
    has '^deadline-past commands received 0' && has '^deadline-stamp0 commands received 0' &&
    lacks 'KeyboardInterrupt'
}

cell_label_of_profile() {
  has '^run .* ideal, inprocess, seed 7' && has '^profile: ideal' && has '^seed: 7' &&
    has 'actuator.dead_time: 0.0' && lacks 'irb120'
}

cell_parameter_files() {
  counts 4 '^completed +yes' && has '^out/.*_line_analytical_80mms' && lacks '^cell:'
}

cell_start_is_ignored() {
  counts 1 '^tracking error' && counts 3 '^cell: parameter start\..* would have no effect'
}

cell_tip_radius_zero() {
  has '^completed +yes' && has 'tip_radius=0' && has '^status 0' && lacks 'Traceback'
}

ctrl_c_in_the_solver() {
  counts 20 "status 130 after .*'cell: interrupted'. False"
}

ctrl_c_while_importing() {
  has "^.'push_bringup', 'cell'. 130 .('cell: interrupted')?.$" &&
    has "^.'push_bag', 'info'. 130 .('info: interrupted')?.$" &&
    has "^.'push_mpc', 'mpc_node'. 130 ..$" && lacks 'Traceback|Error'
}

import_csv_runs() {
  has 'r_still.csv: the (tip|object) does not move' && has 'r_gap.csv, line 1002: .* missing' &&
    has 'r_one.csv, line 2: is the only row' && has '^completed +yes' &&
    has '^tracking error +mean [0-4]\.' && counts 1 '^completed'
}

import_csv_units() {
  counts 1 '^completed +yes' && counts 1 '^tracking error' &&
    has 'r_mm.csv, line 2: .*metres are expected' && has 'r_cm.csv.*metres are expected' &&
    has 'r_deg.csv: slider_theta_rad looks like degrees' && has '^calibrate: .*metres are expected'
}

mcap_chunk_above_64_MiB() {
  has '^/camera .* 109 ' && has '^completed +yes' && has '^2830 messages of 9 topics saved' &&
    has '^0 messages and 0.00 s missing, 0 B damaged' && has '^status 0'
}

mcap_order_of_file() {
  has '^/chatter +std_msgs/msg/String +200 +0 +100\.0 +10\.0$' && has '^0 of 200 messages lost' &&
    has '^0 messages and 0.00 s missing, 0 B damaged'
}

mcap_recover_encodings() {
  counts 4 "'encoding': 'ros2idl'" && counts 4 "'encoding': 'jsonschema'" &&
    counts 4 "'message_encoding': 'json'" &&
    counts 4 "'message_encoding': 'text', 'metadata': .'origin': 'plc'.*'schema_id': 0" &&
    lacks "'encoding': 'ros2msg'"
}

mcap_recover_metadata() {
  counts 2 "'name': 'operator', 'metadata': .'who': 'me'" && counts 2 "'name': 'rosbag2'" &&
    counts 4 "'calibration': 'v3'" &&
    counts 2 "'create_time': 5, 'log_time': 7, 'name': 'photo.png', 'media_type': 'image/png'"
}

mcap_unnumbered_lost() {
  has 'how many were lost is not known' && lacks '^0 of 40 messages lost'
}

no_home() {
  has '^cell: .*HOME is not set: set ROS_LOG_DIR' && has '^cell: .*/proc/1.*: set ROS_LOG_DIR' &&
    has "^cell: ROS_DOMAIN_ID is 'abc', must be a whole number" &&
    has '^replay: .*HOME is not set: set ROS_LOG_DIR' && has '^0 of 200 messages lost'
}

score_none_nan() {
  has '^tracking error +mean 0\.' && has '2 of 648 on object_pose: not a number' && has '^status 0'
}

score_none_renamed() {
  has '^score: .*no topic object_pose; .* it holds /vicon/box' && has '^completed +not known' &&
    has '^tracking error +none: ' && has '^status 1'
}

score_zero_quaternion() {
  has '^heading error +none: no orientation .* unit quaternion' && has '^heading error +mean 0\.08'
}

terminal_without_utf8() {
  has '^usage: push_gp curve' && has '^usage: push_gp evaluate' &&
    has '^info: standard output is closed' && lacks 'Error'
}

track_csv_forms() {
  counts 5 '^completed +yes' && lacks '^cell:'
}

use_sim_time_as_number() {
  has '^mpc_node: parameter use_sim_time takes bool, not 1'
}

failed=0
for folder in "$scratch"/*/; do
  name=$(basename "$folder")
  [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
  if ! declare -F "$name" > /dev/null; then
    echo "$name: no check"
    continue
  fi
  output=$scratch/$name.txt
  timeout -k 10 600 bash "$folder/run.sh" > "$output" 2>&1 < /dev/null
  if "$name"; then
    echo "$name: as expected"
  else
    failed=1
    echo "$name: NOT as expected, $wanted"
    sed 's/^/    /' "$output"
  fi
done
exit $failed
