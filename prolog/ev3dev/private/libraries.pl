:- module(ev3dev_libraries,
          [ in_library/2                % ?Library, ?Predicates
          ]).

/** <module> Which library has a predicate

For messages about predicates of libraries that are not loaded. Nothing loads
this file before one is needed. `tests/behavior/test_library.pl` compares it
with what the libraries export.
*/

%!  in_library(?Library, ?Predicates) is nondet.
%
%   library(ev3dev/Library) is the one to load for Predicates, a list of
%   Name/Arity. Those of library(ev3dev) are not here.

in_library(sim,
    [ for_seconds/2, sim_add/1, sim_add/2, sim_at/2, sim_collisions/1,
      sim_jam/2, sim_mount/1, sim_mount/2, sim_place/3, sim_plug/2,
      sim_pose/3, sim_press/1, sim_press/2, sim_release/1, sim_remote/2,
      sim_remove/1, sim_restore/1, sim_show/3, sim_snapshot/1, sim_start/1,
      sim_start/2, sim_step/1, sim_stop/0, sim_svg/1, sim_time/1,
      sim_trace/1, sim_unmount/0, sim_unplug/1, sim_unshow/2,
      sim_wait/1, sim_where/0,
      with_sim/2, with_sim/3
    ]).
in_library(drive,
    [ arc/2, arc/3, arc_cm/3, arc_cm/4, calibrate/3, drive_cm/2,
      drive_cm/3, drive_option/2, drive_wait/2, face/1, face/2, follow/1,
      follow/2, go_cm/3, go_to/1, go_to/2, go_to/3, go_to/4,
      heading_wrapped/2, pose/3, pose_uncertainty/1, set_pose/3, steer/2,
      steer/3, turn/3
    ]).
in_library(events,
    [ after/2, after/3, both/2, event/2, event_cancel/1, every/2, every/3,
      on/2, on/3, race/2, until/2, until/3
    ]).
in_library(rules,
    [ become/1, behave/1, behave/2, received/1, send_message/1,
      set_state/1, state/1
    ]).
in_library(grid,
    [ direction_heading/2, execute_plan/1, free_cell/2, grid_beside/4,
      grid_bounds/5, grid_cell/2, grid_changed/3, grid_cost/4,
      grid_costs/4, grid_direction/2, grid_map/2, grid_neighbors/2,
      grid_place/2, grid_problem/4, grid_start/2, grid_step/4, grid_turn/4,
      obstacle_add/1, obstacle_remove/1, obstructed/1, plan_and_go_to/2,
      plan_and_go_to/3, set_grid/1, state_position/2
    ]).
in_library(roadmap,
    [ navigate_to/2, navigate_to/3, roadmap_legs/5, roadmap_path/4,
      roadmap_path/5, roadmap_svg/5
    ]).
in_library(planners,
    [ compare_planners/3, plan/3, plan/4, planner/1, planner_claim/2,
      planning/3, replan/5
    ]).
in_library(golog,
    [ ask_execute/2, ask_exog_occurs/1, checkOtherExog/1, do/2, do/3,
      domain/2, eval/3, final/2, finalizeExog/0, finalizeRcx/0,
      get_integer/3, getdomain/2, golog/2, golog_exog/1, has_val/3,
      holds/2, indigolog/0, indigolog/1, initializeExog/0, initializeRcx/0,
      now/1, pathfind/3, rdomain/2, receiveRcxActionNumber/1,
      report_message/2, sendRcxActionNumber/2, sensing_action/2,
      set_option/2, shuffle/2, trans/4, why_not/1, why_not/2
    ]).
in_library(pddl,
    [ pddl_domain/1, pddl_problem/1, pddl_write/1
    ]).
in_library(view,
    [ view/0, view/1, view_mark/1, view_stop/0, view_url/1, view_value/2,
      view_watch/2
    ]).
in_library(journal,
    [ because/2, journal/1, journal_replay/1, why/1, why/2
    ]).
in_library(jog,
    [ jog/0, jog/1
    ]).
in_library(colors,
    [ col_hsv/2, col_rgb/2, col_white/1, color_name/2
    ]).
in_library(console,
    [ screen_forget/0, screen_format/2, screen_print/1
    ]).
in_library(raw,
    [ analog_voltage/2, i2c_read/4, i2c_write/3
    ]).
in_library(plnxt,
    [ nxt_close/0, nxt_go/1, nxt_go_cm/2, nxt_go_sec/2, nxt_goal/2,
      nxt_goal/3, nxt_light/1, nxt_light_LED/1, nxt_light_LED/2,
      nxt_open/0, nxt_play_tone/2, nxt_robot/2, nxt_rotate/2, nxt_sound/1,
      nxt_stop/0, nxt_threads/0, nxt_touch/1, nxt_touch/2, nxt_turn/2,
      nxt_ultrasonic/1, nxt_ultrasonic/2, timer_create/3, timer_create/4,
      timer_kill/1, timer_killall/0, trigger_create/3, trigger_create/4,
      trigger_kill/1, trigger_killall/0
    ]).
in_library(compile,
    [ ev3dev_compile/0
    ]).
