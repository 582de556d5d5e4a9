:- module(ev3dev_native,
          [ % Devices and attributes
            attribute_/4,               % +Class, ?Port, +Attribute, ?Value
            attribute_write_/4,         % +Class, +Port, +Attribute, +Value
            device_/4,                  % +Class, ?Port, ?Type, ?Path
            file_read_/2,               % +File, -Value
            file_write_/2,              % +File, +Value
            subsystem_detect_/4,        % ?Port, ?Type, ?Path, +Pattern
            sysfs_/1,                   % -Root
            sysfs_use_/1,               % +Root
            % Device files
            dev_/1,                     % -Directory
            dev_use_/1,                 % +Directory
            % Motors
            motor_position_/2,          % ?Port, -Position
            motor_set_position_/2,      % +Port, +Position
            motor_reset_/1,             % +Port
            motor_run_/2,               % +Port, +Percent
            motor_stop_/3,              % +Class, +Port, +StopAction
            motor_turn_/3,              % +Moves, +Options, -Reason
            motor_wait_/3,              % +Ports, +Timeout, -Reason
            motor_wait_flag_/3,         % +Port, +Flag, +Present
            motors_run_/1,              % +Runs
            run_forever_/2,             % +Port, +CountsPerSecond
            stop_all_motors_/0,
            motor_run_direct_/3,        % +Class, +Port, +Percent
            % Motors without rotation sensor
            dc_motor_run_/2,            % +Port, +Percent
            dc_motor_run_timed_/5,      % +Port, +Percent, +Seconds, +Options, -Reason
            % Servo motors
            servo_motor_float_/1,       % +Port
            servo_position_/2,          % ?Port, -Percent
            servo_set_position_/2,      % +Port, +Percent
            % Sensors
            sensor_restart_/3,          % +Port, +Types, +Mode
            sensor_scale_/3,            % +Port, +Raw, -Value
            sensor_value_/5,            % ?Port, +Types, +Mode, +Index, -Value
            sensor_values_/5,           % ?Port, +Types, +Mode, +Count, ?Values
            % Lights
            led_/3,                     % ?Light, +What, -Value
            led_set_colour_/2,          % +Light, +Colour
            led_set_delays_/3,          % +Light, +On, +Off
            led_set_trigger_/2,         % +Light, +Trigger
            % Buttons
            button_event_/4,            % +Source, +Index, -Key, -Event
            button_source_/1,           % -Source
            button_wait_/3,             % ?Key, ?Event, +Timeout
            buttons_/1,                 % -Keys
            % Sound
            play_/1,                    % +File
            say_/1,                     % +Text
            sound_stop_/0,
            tones_/1,                   % +Tones
            volume_/1,                  % -Percent
            volume_set_/1,              % +Percent
            % Screen
            screen_clear_/0,
            screen_draw_/2,             % +Shape, +style(Color, Width, Fill)
            screen_image_/3,            % +X, +Y, +File
            screen_png_/1,              % +File
            screen_show_/0,
            screen_write_/4,            % +X, +Y, +Text, +letters(Color, Background, Font, Scale, Align)
            % Battery
            battery_/2,                 % +Key, -Value
            % Ports
            port_device_/2,             % ?Port, -Type
            port_set_device_/2,         % +Port, +Name
            port_set_mode_/2,           % +Port, +Mode
            % Turns by a gyro
            turn_by_gyro_/5,            % +Gyro, +wheels(Left, Right, LeftSign, RightSign, Gearing), +Percent, +Degrees, -Ended
            % Driving and odometry
            drive_/4,                   % +Robot, +Course, +Options, -Reason
            drive_pause_/1,             % +Seconds
            drive_wait_/3,              % +Robot, +Timeout, -Reason
            heading_wrapped_/2,         % +Heading, -Wrapped
            odometry_/1,                % +Robot
            pose_/5,                    % +Robot, +UseGyro, -X, -Y, -Heading
            pose_uncertainty_/3,        % +Robot, +UseGyro, -Rows
            set_pose_/5,                % +Robot, +UseGyro, +X, +Y, +Heading
            % Roadmaps
            roadmap_/5,                 % +Facts, +Start, +Goal, +Options, -Way
            roadmap_svg_/5,             % +Facts, +Start, +Goal, +Options, -Text
            % Navigation
            steer_/5,                   % +Way, +pose(X, Y, Heading), +Before, -Gone, -DegreesPerCm
            views_block_/2,             % +Views, +Point
            views_forget_/1,            % +Views
            views_look_/5,              % +Views, +pose(X, Y, Heading), +sensor(X, Y, Heading), +Range, -Moved
            views_new_/2,               % +Radius, -Views
            views_obstacles_/3,         % +Views, +Facts, -Polygons
            views_step_/5,              % +Views, +Facts, +way(Start, Goal, Margin), +Options, -Step
            % Simulator
            sim_active_/0,
            sim_add_/2,                 % +Fact, -Id
            sim_check_/1,               % +Fact
            sim_collisions_/1,          % -Collisions
            sim_hold_/0,
            sim_jam_/2,                 % +Port, +Bool
            sim_mount_/2,               % +Directory, ?DevDirectory
            sim_place_/3,               % +X, +Y, +Heading
            sim_plug_/2,                % +Port, +Type
            sim_pose_/3,                % -X, -Y, -Heading
            sim_release_/0,
            sim_remote_/2,              % +Channel, +Buttons
            sim_remove_/1,              % +Id
            sim_restore_/1,             % +Snapshot
            sim_show_/3,                % +Port, +Attribute, +Text
            sim_snapshot_/1,            % -Snapshot
            sim_start_/6,               % +WorldFacts, +RobotFacts, +Clock, +Seed, +Noise, +ScreenBits
            sim_step_/1,                % +Seconds
            sim_stop_/0,
            sim_svg_/1,                 % -Text
            sim_time_/1,                % -Seconds
            sim_trace_/1,               % -Trace
            sim_unmount_/0,
            sim_unplug_/1,              % +Port
            sim_unshow_/2,              % +Port, +Attribute
            sim_wait_/1,                % +Seconds
            sim_key_/2,                 % +Key, +IsPress
            sim_plan_key_/3,            % +Key, +After, +For
            % The end of the program
            stop_started_/0
          ]).
:- use_module(library_file, []).

/** <module> The native predicates

All that the foreign library defines, and the only way to it. The modules that
make predicates of them import them from here. A native predicate `p_/N` belongs
to `src/`: there its comment says what it does, and which public predicate it
serves. It expects arguments of the right types, evaluated; it throws ISO errors,
and fails where a device is missing.
*/
