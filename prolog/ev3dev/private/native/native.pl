:- module(ev3dev_native,
          [
            % src/battery.rs
            battery_/2,                 % +Key, -Value
            % src/bricks.rs
            brick_/1,                   % -Number
            brick_use_/1,               % +Number
            brick_open_/1,              % -Number
            brick_close_/1,             % +Number
            far_guard_/1,               % -Thread
            stop_turning_/1,            % -Ports
            stop_all_bricks_/0,
            % src/buttons.rs
            buttons_/1,                 % -Keys
            button_wait_/4,             % ?Key, ?Event, +Timeout, -Reason
            button_source_/1,           % -Source
            button_event_/5,            % +Source, +Index, -Key, -Event, ..
            % src/dc_motors.rs
            dc_motor_run_/2,            % +Port, +Percent
            dc_motor_run_timed_/5,      % +Port, +Percent, +Seconds, ..
            % src/drive.rs
            odometry_/1,                % +Robot
            pose_/5,                    % +Robot, +UseGyro, -X, -Y, -Heading
            set_pose_/5,                % +Robot, +UseGyro, +X, +Y, +Heading
            pose_uncertainty_/3,        % +Robot, +UseGyro, -Rows
            heading_wrapped_/2,         % +Heading, -Wrapped
            drive_/4,                   % +Robot, +Course, +Options, -Reason
            drive_wait_/3,              % +Robot, +Timeout, -Reason
            % src/driver.rs
            device_/3,                  % +Class, ?Port, ?Type
            device_/4,                  % +Class, ?Port, ?Type, ?Path
            attribute_/4,               % +Class, ?Port, +Attribute, ?Value
            attribute_write_/4,         % +Class, +Port, +Attribute, +Value
            % src/files.rs
            subsystem_detect_/4,        % ?Port, ?Type, ?Path, +Pattern
            file_read_/2,               % +File, -Value
            file_write_/2,              % +File, +Value
            stale_mount_/1,             % +Directory
            sysfs_/1,                   % -Root
            sysfs_use_/1,               % +Root
            dev_/1,                     % -Directory
            dev_use_/1,                 % +Directory
            % src/grid.rs
            grid_drawn_/2,              % +Rows, -Drawn
            % src/halt.rs
            running_/1,                 % -Ports
            at_halt_/1,                 % +Stops
            halt_canceled_/0,
            told_to_end_/0,
            stop_started_/0,
            halts_by_/1,                % +Signal
            % src/journal.rs
            cause_/2,                   % -Cause, -Former
            cause_now_/1,               % -Cause
            cause_set_/1,               % +Cause
            cause_active_/1,            % +Cause
            journal_entry_/4,           % -Time, -Act, -Cause, -Called
            journal_new_/1,             % -Done
            % src/lights.rs
            led_/3,                     % ?Light, +What, -Value
            led_set_color_/2,           % +Light, +Color
            led_set_trigger_/2,         % +Light, +Trigger
            led_set_delays_/3,          % +Light, +On, +Off
            % src/localize.rs
            map_new_/2,                 % +sensor, -Mapper
            map_look_/3,                % +Mapper, +pose, +Distance
            map_occupancy_/4,           % +Mapper, +X, +Y, -Probability
            map_cells_/3,               % +Mapper, -Side, -Cells
            map_walls_/3,               % +Mapper, -Extent, -Walls
            map_frontier_/5,            % +Mapper, +X, +Y, +Hull, -Place
            localize_new_/3,            % +Facts, +Options, -Localizer
            localize_at_/3,             % +Localizer, +pose, +Deviation
            localize_reset_/1,          % +Localizer
            localize_step_/6,           % +Localizer, +Robot, +UseGyro, ..
            localize_correct_/3,        % +Localizer, +Robot, +UseGyro
            localize_best_/5,           % +Localizer, +Robot, +UseGyro, ..
            localize_sure_/4,           % +Localizer, -Confidence, -Fit, ..
            localize_clusters_/2,       % +Localizer, -Clusters
            localize_particles_/2,      % +Localizer, -Particles
            % src/motors.rs
            motor_run_/2,               % +Port, +Speed
            run_forever_/2,             % +Port, +CountsPerSecond
            motors_run_/1,              % +Runs
            motor_turn_/3,              % +Moves, +Options, -Reason
            motor_stop_/3,              % +Class, +Port, +StopAction
            stop_all_motors_/0,
            commands_/1,                % -Count
            motors_stop_/2,             % +From, +Before
            motors_leave_/2,            % +From, +Before
            motor_reset_/1,             % +Port
            motor_wait_/3,              % +Ports, +Timeout, -Reason
            motor_wait_flag_/4,         % +Port, +Flag, +Present, -Reason
            motor_run_direct_/3,        % +Class, +Port, +Percent
            motor_position_/2,          % ?Port, -Position
            motor_speed_/2,             % ?Port, -Speed
            motor_counts_/3,            % +Port, +Constant, -Counts
            motor_gear_/2,              % ?Port, -Ratio
            motor_set_gear_/2,          % +Port, +Ratio
            motor_set_position_/2,      % +Port, +Position
            % src/navigation.rs
            views_new_/2,               % +Radius, -Views
            views_look_/5,              % +Views, +pose, +sensor, +Range, ..
            views_forget_/1,            % +Views
            views_block_/2,             % +Views, +Place
            views_obstacles_/3,         % +Views, +Facts, -Polygons
            views_step_/5,              % +Views, +Facts, +way, +Options, ..
            steer_/5,                   % +Way, +pose, +Before, -Gone, ..
            % src/planner.rs
            planner_new_/3,             % +Task, +Cheapest, -Planner
            planner_work_/4,            % +Planner, +Steps, -Progress, -States
            planner_end_/1,             % +Planner
            % src/ports.rs
            port_set_mode_/2,           % +Port, +Mode
            port_device_/2,             % ?Port, -Type
            port_set_device_/2,         % +Port, +Name
            % src/roadmap.rs
            roadmap_/5,                 % +Facts, +Start, +Goal, +Options, ..
            roadmap_svg_/5,             % +Facts, +Start, +Goal, +Options, ..
            % src/screen.rs
            screen_clear_/0,
            screen_draw_/2,             % +Shape, +style
            screen_write_/4,            % +X, +Y, +Text, +letters
            screen_image_/3,            % +X, +Y, +File
            screen_show_/0,
            screen_png_/1,              % +File
            % src/sensors.rs
            sensor_known_/3,            % +Reading, ?Port, ?Value
            sensor_value_/5,            % ?Port, +Types, +Mode, +Index, -Value
            sensor_value_or_why_/5,     % ?Port, +Types, +Mode, +Index, -Value
            sensor_values_/5,           % ?Port, +Types, +Mode, +Count, ..
            sensor_restart_/3,          % +Port, +Types, +Mode
            sensor_wait_/5,             % +Port, +Reading, +Test, +Timeout, ..
            sensor_scale_/3,            % +Port, +Raw, -Value
            i2c_read_/4,                % +Port, +Register, +Count, -Bytes
            i2c_write_/3,               % +Port, +Register, +Bytes
            % src/servo_motors.rs
            servo_position_/2,          % ?Port, -Percent
            servo_set_position_/2,      % +Port, +Percent
            servo_motor_float_/1,       % +Port
            % src/sim/buttons.rs
            sim_key_/2,                 % +Key, +IsPress
            sim_plan_key_/3,            % +Key, +After, +For
            % src/sim/fence.rs
            sim_fence_open_/2,          % +Path, +Inferences
            sim_fence_serve_/3,         % +Until, +Wall, -State
            sim_fence_silent_/0,
            process_usage_/5,           % +Process, -Seconds, -Rest, ..
            sim_fence_close_/0,
            sim_fence_join_/1,          % +Path
            % src/sim/limit.rs
            limit_call_/2,              % +Id, :Goal
            limit_insist_/4,            % +Id, +Thread, :Goal, +Ball
            % src/sim/mod.rs
            sim_check_/2,               % +Subject, +Fact
            sim_forms_/1,               % -Forms
            sim_start_/4,               % +WorldFacts, +RobotFacts, ..
            sim_crowd_/4,               % +WorldFacts, +Robots, +Options, ..
            sim_fault_/3,               % +WorldFacts, +RobotFacts, -Fault
            sim_stop_/0,
            sim_active_/0,
            sim_pose_/3,                % -X, -Y, -Heading
            sim_place_/3,               % +X, +Y, +Heading
            sim_add_/2,                 % +Fact, -Id
            sim_remove_/1,              % +Id
            sim_plug_/2,                % +Port, +Type
            sim_unplug_/1,              % +Port
            sim_detecting_/1,           % +Port
            sim_jam_/2,                 % +Port, +Bool
            sim_show_/3,                % +Port, +Attribute, +Text
            sim_unshow_/2,              % +Port, +Attribute
            sim_wait_/2,                % +Seconds, -Reason
            sim_plan_/1,                % +Seconds
            sim_remote_/2,              % +Channel, +Buttons
            sim_step_/1,                % +Seconds
            sim_time_/1,                % -Seconds
            sim_unseen_/0,
            sim_clock_/1,               % -Seconds
            sim_snapshot_/1,            % -Snapshot
            sim_snapshots_/1,           % -Count
            sim_restore_/1,             % +Snapshot
            sim_collisions_/1,          % -Collisions
            sim_things_/1,              % -Things
            sim_held_/1,                % -Names
            sim_trace_/1,               % -Trace
            sim_svg_/1,                 % -Text
            sim_mount_/2,               % +Directory, ?DevDirectory
            sim_unmount_/0,
            % src/sound.rs
            tones_/3,                   % +Tones, +Wait, -Reason
            say_/3,                     % +Text, +Wait, -Reason
            play_/3,                    % +File, +Wait, -Reason
            volume_/1,                  % -Percent
            volume_set_/1,              % +Percent
            sound_wait_/1,              % -Reason
            sound_stop_/0,
            % src/time.rs
            now_/1,                     % -Seconds
            wait_/2,                    % +Seconds, -Reason
            thought_begins_/1,          % -Inferences
            thought_nothing_/2,         % +Inferences, +Before
            guards_/0,
            tick_after_/1,              % +Seconds
            tick_at_once_/0,
            branches_begin_/0,
            branches_leave_/0,
            read_on_/0,
            serve_if_due_/0,
            branches_look_/2,           % -Seconds, -Bricks
            branches_end_/0,
            serve_at_prompt_/0,
            slices_/1,                  % -Count
            % src/view/door.rs
            view_serve_/5,              % +Address, +Port, +Token, +Files, ..
            view_visit_/1,              % -Visit
            view_hear_/3,               % +Page, +Seconds, -Line
            view_say_/2,                % +Page, +Json
            view_end_/2,                % +Page, +Code
            view_leave_/1,              % +Page
            view_shut_/1,               % +Bye
            % src/view/frame.rs
            view_frame_/6,              % +Page, +Have, +State, +Rate, ..
            view_source_/1,             % -Source
            % src/view/hand.rs
            view_pace_/1,               % +Factor
            view_pause_/1,              % +Pauses
            view_step_/2,               % +Seconds, +IsIdle
            view_stands_/0,
            view_facts_/1,              % -Text
            view_held_/0,
            view_pull_/1,               % +Port
            view_put_back_/2,           % +Port, -Driver
            view_move_/4,               % +Id, +X, +Y, +Heading
            % src/view/located.rs
            map_show_/1,                % +Mapper
            localize_show_/1,           % +Localizer
            % src/view/mod.rs
            view_open_/0,
            view_expect_/0,
            view_close_/0,
            view_thread_/1,             % +Serves
            view_show_/1,               % +Brick
            view_has_robot_/1,          % +Brick
            view_keep_/2,               % +Name, +Json
            view_log_/6,                % +Time, +Kind, +Text, +Causes, ..
            view_value_/2,              % +Name, +Number
            view_prints_/1,             % +Keeps
            view_printed_/3,            % +Ended, -Times, -Texts
            view_latch_/0,
            view_lift_/0,
            view_stop_motors_/0,
            view_users_/1,              % -Threads
            view_serves_/0,
            view_to_world_/5,           % +X, +Y, -WorldX, -WorldY, -Turn
            view_part_/0
          ]).
:- use_module('../errors/errors', []).
:- use_module(library_file, [check_natives/1]).

/** <module> The native predicates

All that the foreign library defines, and the only way to it. The modules that
make predicates of them import them from here. `tools/natives.py --renew`
makes the list of exports from `natives!` of the files below `src/`, whose
comments say what each predicate does. It expects arguments of the right
types, with expressions evaluated. It throws ISO errors, and fails if a device
is missing.
*/

% This directive stands last.
:- check_natives(ev3dev_native).
