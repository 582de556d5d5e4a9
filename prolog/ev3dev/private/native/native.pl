:- module(ev3dev_native,
          [ brick_/1,
            brick_close_/1,
            brick_open_/1,
            brick_use_/1,
            stop_all_bricks_/0,
            attribute_/4,
            attribute_write_/4,
            device_/3,
            device_/4,
            dev_/1,
            dev_use_/1,
            file_read_/2,
            file_write_/2,
            stale_mount_/1,
            subsystem_detect_/4,
            sysfs_/1,
            sysfs_use_/1,
            now_/1,
            wait_/2,
            branches_begin_/0,
            branches_leave_/0,
            branches_look_/2,
            branches_end_/0,
            guards_/0,
            commands_/1,
            motors_leave_/2,
            motors_stop_/2,
            read_on_/0,
            serve_at_prompt_/0,
            serve_if_due_/0,
            slices_/1,
            tick_after_/1,
            tick_at_once_/0,
            motor_counts_/3,
            motor_gear_/2,
            motor_position_/2,
            motor_reset_/1,
            motor_run_/2,
            motor_run_direct_/3,
            motor_set_gear_/2,
            motor_set_position_/2,
            motor_speed_/2,
            motor_stop_/3,
            motor_turn_/3,
            motor_wait_/3,
            motor_wait_flag_/4,
            motors_run_/1,
            run_forever_/2,
            stop_all_motors_/0,
            dc_motor_run_/2,
            dc_motor_run_timed_/5,
            servo_motor_float_/1,
            servo_position_/2,
            servo_set_position_/2,
            sensor_restart_/3,
            sensor_scale_/3,
            sensor_known_/3,
            sensor_value_/5,
            sensor_value_or_why_/5,
            sensor_values_/5,
            sensor_wait_/5,
            i2c_read_/4,
            i2c_write_/3,
            led_/3,
            led_set_color_/2,
            led_set_delays_/3,
            led_set_trigger_/2,
            button_event_/5,
            button_source_/1,
            button_wait_/4,
            buttons_/1,
            sim_key_/2,
            sim_plan_key_/3,
            play_/3,
            say_/3,
            sound_stop_/0,
            sound_wait_/1,
            tones_/3,
            volume_/1,
            volume_set_/1,
            screen_clear_/0,
            screen_draw_/2,
            screen_image_/3,
            screen_png_/1,
            screen_show_/0,
            screen_write_/4,
            battery_/2,
            port_device_/2,
            port_set_device_/2,
            port_set_mode_/2,
            drive_/4,
            drive_wait_/3,
            heading_wrapped_/2,
            odometry_/1,
            pose_/5,
            pose_uncertainty_/3,
            set_pose_/5,
            grid_drawn_/2,
            roadmap_/5,
            roadmap_svg_/5,
            steer_/5,
            map_cells_/3,
            map_frontier_/5,
            map_look_/3,
            map_new_/2,
            map_occupancy_/4,
            map_show_/1,
            map_walls_/3,
            localize_at_/3,
            localize_best_/5,
            localize_clusters_/2,
            localize_correct_/3,
            localize_new_/3,
            localize_particles_/2,
            localize_reset_/1,
            localize_show_/1,
            localize_step_/6,
            localize_sure_/4,
            views_block_/2,
            views_forget_/1,
            views_look_/5,
            views_new_/2,
            views_obstacles_/3,
            views_step_/5,
            cause_/2,
            cause_active_/1,
            cause_now_/1,
            cause_set_/1,
            journal_entry_/4,
            journal_new_/1,
            limit_call_/2,
            limit_insist_/4,
            process_usage_/3,
            sim_active_/0,
            sim_add_/2,
            sim_check_/2,
            sim_clock_/1,
            sim_collisions_/1,
            sim_crowd_/4,
            sim_detecting_/1,
            sim_fault_/3,
            sim_fence_close_/0,
            sim_fence_join_/1,
            sim_fence_open_/1,
            sim_fence_serve_/3,
            sim_fence_silent_/0,
            sim_jam_/2,
            sim_mount_/2,
            sim_place_/3,
            sim_plan_/1,
            sim_plug_/2,
            sim_pose_/3,
            sim_remote_/2,
            sim_remove_/1,
            sim_restore_/1,
            sim_show_/3,
            sim_snapshot_/1,
            sim_snapshots_/1,
            sim_start_/4,
            sim_step_/1,
            sim_stop_/0,
            sim_svg_/1,
            sim_time_/1,
            sim_trace_/1,
            sim_unmount_/0,
            sim_unplug_/1,
            sim_unshow_/2,
            sim_wait_/2,
            at_halt_/1,
            halt_canceled_/0,
            halts_by_/1,
            running_/1,
            stop_started_/0,
            told_to_end_/0,
            view_close_/0,
            view_end_/2,
            view_facts_/1,
            view_frame_/5,
            view_has_robot_/1,
            view_held_/0,
            view_hear_/3,
            view_keep_/2,
            view_latch_/0,
            view_leave_/1,
            view_lift_/0,
            view_log_/6,
            view_move_/4,
            view_open_/0,
            view_pace_/1,
            view_part_/0,
            view_pause_/1,
            view_printed_/3,
            view_prints_/1,
            view_pull_/1,
            view_put_back_/2,
            view_say_/2,
            view_serve_/5,
            view_serves_/0,
            view_show_/1,
            view_shut_/1,
            view_source_/1,
            view_stands_/0,
            view_step_/2,
            view_stop_motors_/0,
            view_thread_/1,
            view_to_world_/5,
            view_users_/1,
            view_value_/2,
            view_visit_/1
          ]).
:- use_module('../errors/errors', []).
:- use_module(library_file, [check_natives/0]).

/** <module> The native predicates

All that the foreign library defines, and the only way to it. The modules that
make predicates of them import them from here. What a native predicate does is
explained at its place below `src/`. It expects arguments of the right types,
with expressions evaluated. It throws ISO errors, and fails where a device is
missing.
*/

% Bricks

%!  brick_(-Number) is semidet.
%!  brick_close_(+Number) is semidet.
%!  brick_open_(-Number) is semidet.
%!  brick_use_(+Number) is semidet.
%!  stop_all_bricks_ is semidet.
%
%   `src/bricks.rs`

% Devices and attributes

%!  attribute_(+Class, ?Port, +Attribute, ?Value) is nondet.
%!  attribute_write_(+Class, +Port, +Attribute, +Value) is semidet.
%!  device_(+Class, ?Port, ?Type) is nondet.
%!  device_(+Class, ?Port, ?Type, ?Path) is nondet.
%
%   `src/driver.rs`

% Files

%!  dev_(-Directory) is semidet.
%!  dev_use_(+Directory) is semidet.
%!  file_read_(+File, -Value) is semidet.
%!  file_write_(+File, +Value) is semidet.
%!  stale_mount_(+Directory) is semidet.
%!  subsystem_detect_(?Port, ?Type, ?Path, +Pattern) is nondet.
%!  sysfs_(-Root) is semidet.
%!  sysfs_use_(+Root) is semidet.
%
%   `src/files.rs`

% Time

%!  now_(-Seconds) is det.
%!  wait_(+Seconds, -Reason) is nondet.
%!  branches_begin_ is semidet.
%!  branches_leave_ is semidet.
%!  branches_look_(-Seconds, -Bricks) is semidet.
%!  branches_end_ is semidet.
%!  guards_ is semidet.
%!  read_on_ is semidet.
%!  serve_at_prompt_ is semidet.
%!  serve_if_due_ is semidet.
%!  slices_(-Count) is semidet.
%!  tick_after_(+Seconds) is semidet.
%!  tick_at_once_ is semidet.
%
%   `src/time.rs`

% Motors

%!  commands_(-Count) is semidet.
%!  motor_counts_(+Port, +Constant, -Counts) is semidet.
%!  motor_gear_(?Port, -Ratio) is nondet.
%!  motor_position_(?Port, -Position) is nondet.
%!  motor_reset_(+Port) is semidet.
%!  motor_run_(+Port, +Speed) is semidet.
%!  motor_run_direct_(+Class, +Port, +Percent) is semidet.
%!  motor_set_gear_(+Port, +Ratio) is semidet.
%!  motor_set_position_(+Port, +Position) is semidet.
%!  motor_speed_(?Port, -Speed) is nondet.
%!  motor_stop_(+Class, +Port, +StopAction) is semidet.
%!  motor_turn_(+Moves, +Options, -Reason) is nondet.
%!  motor_wait_(+Ports, +Timeout, -Reason) is nondet.
%!  motor_wait_flag_(+Port, +Flag, +Present, -Reason) is nondet.
%!  motors_run_(+Runs) is semidet.
%!  motors_leave_(+From, +Before) is semidet.
%!  motors_stop_(+From, +Before) is semidet.
%!  run_forever_(+Port, +CountsPerSecond) is semidet.
%!  stop_all_motors_ is semidet.
%
%   `src/motors.rs`

% Motors without rotation sensor

%!  dc_motor_run_(+Port, +Speed) is semidet.
%!  dc_motor_run_timed_(+Port, +Percent, +Time, +Options, -Reason) is nondet.
%
%   `src/dc_motors.rs`

% Servo motors

%!  servo_motor_float_(+Port) is semidet.
%!  servo_position_(?Port, -Percent) is nondet.
%!  servo_set_position_(+Port, +Percent) is semidet.
%
%   `src/servo_motors.rs`

% Sensors

%!  sensor_restart_(+Port, +Types, +Mode) is semidet.
%!  sensor_scale_(+Port, +Raw, -Value) is semidet.
%!  sensor_known_(+Reading, ?Port, ?Value) is semidet.
%!  sensor_value_(?Port, +Types, +Mode, +Index, -Value) is nondet.
%!  sensor_value_or_why_(?Port, +Types, +Mode, +Index, -Value) is nondet.
%!  sensor_values_(?Port, +Types, +Mode, +Count, ?Values) is nondet.
%!  sensor_wait_(+Port, +Reading, +Test, +Timeout, -Ended) is nondet.
%!  i2c_read_(+Port, +Register, +Count, -Bytes) is semidet.
%!  i2c_write_(+Port, +Register, +Bytes) is semidet.
%
%   `src/sensors.rs`

% Lights

%!  led_(?Light, +What, -Value) is nondet.
%!  led_set_color_(+Light, +Color) is semidet.
%!  led_set_delays_(+Light, +On, +Off) is semidet.
%!  led_set_trigger_(+Light, +Trigger) is semidet.
%
%   `src/lights.rs`

% Buttons

%!  button_event_(+Source, +Index, -Key, -Event, -Reason) is nondet.
%!  button_source_(-Source) is semidet.
%!  button_wait_(?Key, ?Event, +Timeout, -Reason) is nondet.
%!  buttons_(-Keys) is semidet.
%
%   `src/buttons.rs`

%!  sim_key_(+Button, +IsPress) is semidet.
%!  sim_plan_key_(+Button, +After, +For) is semidet.
%
%   `src/sim/buttons.rs`

% Sound

%!  play_(+File, +Wait, -Reason) is nondet.
%!  say_(+Text, +Wait, -Reason) is nondet.
%!  sound_stop_ is semidet.
%!  sound_wait_(-Reason) is nondet.
%!  tones_(+Tones, +Wait, -Reason) is nondet.
%!  volume_(-Percent) is semidet.
%!  volume_set_(+Percent) is semidet.
%
%   `src/sound.rs`

% Screen

%!  screen_clear_ is semidet.
%!  screen_draw_(+Shape, +Style) is semidet.
%!  screen_image_(+X, +Y, +File) is semidet.
%!  screen_png_(+File) is semidet.
%!  screen_show_ is semidet.
%!  screen_write_(+X, +Y, +Text, +Letters) is semidet.
%
%   `src/screen.rs`

% Battery

%!  battery_(+Key, -Value) is semidet.
%
%   `src/battery.rs`

% Ports

%!  port_device_(?Port, -Type) is nondet.
%!  port_set_device_(+Port, +Name) is semidet.
%!  port_set_mode_(+Port, +Mode) is semidet.
%
%   `src/ports.rs`

% Driving and odometry

%!  drive_(+Robot, +Course, +Options, -Reason) is nondet.
%!  drive_wait_(+Robot, +Timeout, -Reason) is nondet.
%!  heading_wrapped_(+Heading, -Wrapped) is semidet.
%!  odometry_(+Robot) is semidet.
%!  pose_(+Robot, +UseGyro, -X, -Y, -Heading) is semidet.
%!  pose_uncertainty_(+Robot, +UseGyro, -Rows) is semidet.
%!  set_pose_(+Robot, +UseGyro, +X, +Y, +Heading) is semidet.
%
%   `src/drive.rs`

% The journal

%!  cause_(-Cause, -Former) is nondet.
%!  cause_active_(+Cause) is semidet.
%!  cause_now_(-Cause) is det.
%!  cause_set_(+Cause) is semidet.
%!  journal_entry_(-Time, -Act, -Cause, -Called) is nondet.
%!  journal_new_(-Done) is det.
%
%   `src/journal.rs`

% Grids

%!  grid_drawn_(+Rows, -Drawn) is det.
%
%   `src/grid.rs`

% Roadmaps

%!  roadmap_(+Facts, +Start, +Goal, +Options, -Way) is semidet.
%!  roadmap_svg_(+Facts, +Start, +Goal, +Options, -Text) is semidet.
%
%   `src/roadmap.rs`

% Navigation

%!  steer_(+Way, +Pose, +Before, -Gone, -DegreesPerCm) is semidet.
%!  views_block_(+Views, +Place) is semidet.
%!  views_forget_(+Views) is semidet.
%!  views_look_(+Views, +Pose, +Sensor, +Range, -Moved) is semidet.
%!  views_new_(+Radius, -Views) is semidet.
%!  views_obstacles_(+Views, +Facts, -Polygons) is semidet.
%!  views_step_(+Views, +Facts, +Way, +Options, -Step) is semidet.
%
%   `src/navigation.rs`

% Localization

%!  map_cells_(+Mapper, -Side, -Cells) is semidet.
%!  map_frontier_(+Mapper, +X, +Y, +Hull, -Place) is semidet.
%!  map_look_(+Mapper, +Pose, +Cm) is semidet.
%!  map_new_(+Sensor, -Mapper) is semidet.
%!  map_occupancy_(+Mapper, +X, +Y, -Probability) is semidet.
%!  map_walls_(+Mapper, -Bounds, -Walls) is semidet.
%!  localize_at_(+Localizer, +Pose, +Deviation) is semidet.
%!  localize_best_(+Localizer, +Robot, +UseGyro, -Pose, -Covar) is semidet.
%!  localize_clusters_(+Localizer, -Clusters) is semidet.
%!  localize_correct_(+Localizer, +Robot, +UseGyro) is semidet.
%!  localize_new_(+Facts, +Options, -Localizer) is semidet.
%!  localize_particles_(+Localizer, -Particles) is semidet.
%!  localize_reset_(+Localizer) is semidet.
%!  localize_step_(+Localizer, +Robot, +UseGyro, +Cm, -Step, -By) is semidet.
%!  localize_sure_(+Localizer, -Confidence, -Fit, -MustLook) is semidet.
%
%   `src/localize.rs`

% Simulator

%!  sim_active_ is semidet.
%!  sim_add_(+Fact, -Id) is semidet.
%!  sim_check_(+Subject, +Fact) is semidet.
%!  sim_clock_(-Seconds) is semidet.
%!  sim_collisions_(-Collisions) is semidet.
%!  sim_crowd_(+World, +Robots, +Options, -Fault) is semidet.
%!  sim_detecting_(+Port) is semidet.
%!  sim_fault_(+World, +Robot, -Fault) is semidet.
%!  sim_jam_(+Port, +Bool) is semidet.
%!  sim_mount_(+Directory, ?DevDirectory) is semidet.
%!  sim_place_(+X, +Y, +Heading) is semidet.
%!  sim_plan_(+Seconds) is semidet.
%!  sim_plug_(+Port, +Type) is semidet.
%!  sim_pose_(-X, -Y, -Heading) is semidet.
%!  sim_remote_(+Channel, +Buttons) is semidet.
%!  sim_remove_(+Id) is semidet.
%!  sim_restore_(+Snapshot) is semidet.
%!  sim_show_(+Port, +Attribute, +Text) is semidet.
%!  sim_snapshot_(-Snapshot) is semidet.
%!  sim_snapshots_(-Count) is semidet.
%!  sim_start_(+World, +Robot, +Options, -Fault) is semidet.
%!  sim_step_(+Seconds) is semidet.
%!  sim_stop_ is semidet.
%!  sim_svg_(-Text) is semidet.
%!  sim_time_(-Seconds) is semidet.
%!  sim_trace_(-Trace) is semidet.
%!  sim_unmount_ is semidet.
%!  sim_unplug_(+Port) is semidet.
%!  sim_unshow_(+Port, +Attribute) is semidet.
%!  sim_wait_(+Seconds, -Reason) is nondet.
%
%   `src/sim/mod.rs`

%!  limit_call_(+Id, :Goal) is semidet.
%!  limit_insist_(+Id, +Thread, :Goal, +Ball) is semidet.
%
%   `src/sim/limit.rs`

%!  process_usage_(+Process, -Seconds, -Rest) is semidet.
%!  sim_fence_close_ is det.
%!  sim_fence_join_(+Path) is det.
%!  sim_fence_open_(+Path) is semidet.
%!  sim_fence_serve_(+Until, +Wall, -State) is semidet.
%!  sim_fence_silent_ is semidet.
%
%   `src/sim/fence.rs`

% The view

%!  view_close_ is det.
%!  view_frame_(+Page, +Have, +State, +Rate, +Goals) is det.
%!  view_has_robot_(+Brick) is semidet.
%!  view_keep_(+Name, +Json) is det.
%!  view_latch_ is det.
%!  view_lift_ is det.
%!  view_log_(+Time, +Kind, +Text, +Causes, +About, +Thread) is det.
%!  view_open_ is det.
%!  view_part_ is det.
%!  view_printed_(+Ended, -Times, -Texts) is det.
%!  view_prints_(+Keeps) is det.
%!  view_serves_ is semidet.
%!  view_show_(+Brick) is semidet.
%!  view_source_(-Source) is det.
%!  view_stop_motors_ is det.
%!  view_thread_(+Serves) is det.
%!  view_to_world_(+X, +Y, -WorldX, -WorldY, -Turn) is det.
%!  view_users_(-Threads) is det.
%!  view_value_(+Name, +Number) is det.
%
%   `src/view/mod.rs`

%!  view_end_(+Page, +Code) is semidet.
%!  view_hear_(+Page, +Seconds, -Line) is semidet.
%!  view_leave_(+Page) is semidet.
%!  view_say_(+Page, +Json) is det.
%!  view_serve_(+Address, +Port, +Token, +Files, -Served) is det.
%!  view_shut_(+Bye) is semidet.
%!  view_visit_(-Visit) is semidet.
%
%   `src/view/door.rs`

%!  view_move_(+Id, +X, +Y, +Heading) is semidet.
%!  view_pace_(+Factor) is semidet.
%!  view_facts_(-Text) is semidet.
%!  view_held_ is semidet.
%!  view_pause_(+Pauses) is semidet.
%!  view_pull_(+Port) is semidet.
%!  view_put_back_(+Port, -Driver) is semidet.
%!  view_stands_ is semidet.
%!  view_step_(+Seconds, +IsIdle) is semidet.
%
%   `src/view/hand.rs`

%!  localize_show_(+Localizer) is semidet.
%!  map_show_(+Mapper) is semidet.
%
%   `src/view/located.rs`

% The end of the program

%!  at_halt_(+Stops) is semidet.
%!  halt_canceled_ is semidet.
%!  halts_by_(+Signal) is semidet.
%!  running_(-Ports) is semidet.
%!  stop_started_ is semidet.
%!  told_to_end_ is semidet.
%
%   `src/halt.rs`

% This directive stands last.
:- check_natives.
