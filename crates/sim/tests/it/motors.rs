//! The state machine of a tacho motor, transition by transition (`docs/ev3dev-sysfs.md`, 3).
use crate::desk::{A, B, C, Desk};
use ev3_sim::facts::Fact;
use ev3_sim::{Access, Descriptor, Errno, Port};
use ev3_sim::{MotorMount, Pose, RobotSpec, WorldSpec};

#[test]
fn running_shows_at_the_very_next_read() {
    let mut desk = Desk::new();
    for command in ["run-forever", "run-direct", "run-timed", "run-to-abs-pos", "run-to-rel-pos"] {
        desk.run(B, &[("speed_sp", 300), ("position_sp", 5000), ("time_sp", 500)], command);
        assert_eq!(desk.state(B), "running", "{command}");
        desk.step(20);
        desk.run(B, &[], "stop");
        assert_eq!(desk.state(B), "", "{command}");
    }
}

#[test]
fn the_three_stop_actions() {
    for (action, state) in [("coast", ""), ("brake", ""), ("hold", "holding")] {
        let mut desk = Desk::new();
        desk.put(&format!("{B}stop_action"), action);
        desk.run(B, &[("speed_sp", 500)], "run-forever");
        desk.run(C, &[("speed_sp", 500)], "run-forever");
        desk.step(1000);
        desk.run(C, &[], "stop");
        desk.run(B, &[], "stop");
        assert_eq!(desk.state(B), state, "{action}");
        let at = desk.position(B);
        desk.step(3000);
        let overshoot = desk.position(B) - at;
        match action {
            "coast" => assert!((20..400).contains(&overshoot), "coasts {overshoot}"),
            "brake" => assert!((5..60).contains(&overshoot), "brakes in {overshoot}"),
            _ => assert!(overshoot.abs() <= 3, "holds within {overshoot}"),
        }
    }
}

#[test]
fn stop_action_is_taken_over_by_the_next_command_only() {
    let mut desk = Desk::new();
    desk.put(&format!("{B}stop_action"), "hold");
    desk.run(B, &[], "stop");
    assert_eq!(desk.state(B), "holding");
    desk.put(&format!("{B}stop_action"), "coast");
    desk.step(100);
    assert_eq!(desk.state(B), "holding");
    desk.run(B, &[], "stop");
    assert_eq!(desk.state(B), "");
}

#[test]
fn setpoints_do_not_touch_a_motion_in_progress() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", 200)], "run-forever");
    desk.put(&format!("{B}speed_sp"), 900);
    desk.step(2000);
    let speed = desk.speed(B);
    assert!((190..=210).contains(&speed), "{speed}");
}

#[test]
fn direct_duty_acts_at_once_and_only_under_run_direct() {
    let mut desk = Desk::new();
    let duty = format!("{B}duty_cycle");
    let set = format!("{B}duty_cycle_sp");
    desk.put(&set, 40);
    assert_eq!(desk.number(&duty), 0);
    desk.run(B, &[], "run-direct");
    assert_eq!(desk.number(&duty), 40);
    desk.put(&set, -60);
    assert_eq!(desk.number(&duty), -60);
    desk.run(B, &[], "stop");
    desk.put(&set, 80);
    assert_eq!((desk.number(&duty), desk.state(B).as_str()), (0, ""));
}

#[test]
fn a_motor_that_never_moves_is_stalled_after_100_ms() {
    let mut desk = Desk::new();
    for (set, command) in [("speed_sp", "run-forever"), ("duty_cycle_sp", "run-direct")] {
        desk.run(B, &[(set, 0)], command);
        assert_eq!(desk.state(B), "running");
        let after = desk.until(B, "running stalled", 200);
        assert!((102..=106).contains(&after), "{command}: {after} ms");
        desk.run(B, &[], "stop");
        assert_eq!(desk.state(B), "");
        desk.run(B, &[(set, 0)], command);
        assert_eq!(desk.state(B), "running stalled", "{command}: no sample came between");
        desk.run(B, &[], "stop");
        desk.step(2);
    }
}

#[test]
fn a_turning_motor_that_is_blocked_is_stalled_after_300_ms() {
    let mut desk = Desk::new();
    desk.run(A, &[("speed_sp", 700)], "run-forever");
    desk.step(1000);
    assert_eq!(desk.state(A), "running");
    desk.0.jam(Port::OutA, true);
    let after = desk.until(A, "running overloaded stalled", 500);
    assert!((280..=360).contains(&after), "{after} ms");
    desk.0.jam(Port::OutA, false);
    desk.until(A, "running", 500);
}

#[test]
fn a_high_setpoint_overloads_for_as_long_as_the_battery_lacks_volts() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", 1050)], "run-forever");
    desk.step(2);
    assert_eq!(desk.state(B), "running overloaded");
    desk.step(3000);
    assert_eq!(desk.state(B), "running overloaded", "8 V are not 9 V");
    assert_eq!(desk.number(&format!("{B}duty_cycle")), 100);
    desk.run(B, &[("speed_sp", 400)], "run-forever");
    desk.step(1000);
    assert_eq!(desk.state(B), "running");
    desk.run(B, &[("duty_cycle_sp", 100)], "run-direct");
    desk.step(100);
    assert_eq!(desk.state(B), "running", "never overloaded in run-direct");
}

#[test]
fn timed_runs_end_as_late_as_the_timer_wheel_has_it_with_their_stop_action() {
    let mut desk = Desk::new();
    desk.put(&format!("{B}stop_action"), "hold");
    desk.run(B, &[("speed_sp", 300), ("time_sp", 503)], "run-timed");
    let took = desk.until(B, "holding", 1000);
    assert_eq!(took, 520, "51 jiffies, and the one that has begun");
    for (time, latest) in [(630, 640), (640, 720), (2000, 2080), (5100, 5740), (41_000, 46_080)] {
        desk.run(B, &[("time_sp", time)], "run-timed");
        let time = u64::try_from(time).unwrap();
        desk.step(time - 2);
        let took = time - 2 + desk.until(B, "holding", 6000);
        assert!((time..=latest).contains(&took), "{time}: {took}");
        assert!(took == latest || time >= 640, "{time}: {took}");
    }
    desk.run(B, &[("time_sp", 0)], "run-timed");
    assert_eq!(desk.state(B), "holding", "no time is over at once");
}

#[test]
fn absolute_moves_ignore_the_sign_of_the_speed() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}stop_action"), "hold");
    desk.run(A, &[("speed_sp", -300), ("position_sp", 200)], "run-to-abs-pos");
    desk.until(A, "holding", 2000);
    desk.step(1000);
    assert!((198..=202).contains(&desk.position(A)), "{}", desk.position(A));
    desk.run(A, &[("speed_sp", 300), ("position_sp", -100)], "run-to-abs-pos");
    desk.until(A, "holding", 2000);
    desk.step(1000);
    assert!((-102..=-98).contains(&desk.position(A)), "{}", desk.position(A));
}

#[test]
fn a_move_to_where_it_is_already_ends_within_2_ms() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", 300), ("position_sp", 0)], "run-to-abs-pos");
    assert_eq!(desk.state(B), "running");
    desk.step(2);
    assert_eq!(desk.state(B), "");
}

#[test]
fn a_move_without_speed_stays_running_then_stalled() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", 0), ("position_sp", 90)], "run-to-abs-pos");
    desk.step(90);
    assert_eq!(desk.state(B), "running");
    desk.step(20_000);
    assert_eq!(desk.state(B), "running stalled");
}

#[test]
fn a_chain_of_relative_moves_counts_from_target_to_target() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}stop_action"), "coast");
    for turn in 1..=3 {
        desk.run(A, &[("speed_sp", 400), ("position_sp", 360)], "run-to-rel-pos");
        desk.until(A, "", 3000);
        let position = desk.position(A);
        assert!((turn * 360..turn * 360 + 60).contains(&position), "turn {turn}: {position}");
        desk.step(1000);
    }
    let coasted = desk.position(A);
    desk.run(A, &[], "stop");
    desk.run(A, &[], "run-to-rel-pos");
    desk.until(A, "", 3000);
    let position = desk.position(A);
    assert!((coasted + 360..coasted + 420).contains(&position), "from the present position");
}

#[test]
fn the_trap_a_zeroed_position_does_not_clear_the_remembered_target() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}stop_action"), "hold");
    let set = [("speed_sp", 400), ("position_sp", 360)];
    desk.run(A, &set, "run-to-rel-pos");
    desk.until(A, "holding", 3000);
    desk.step(500);
    desk.put(&format!("{A}position"), 0);
    desk.run(A, &set, "run-to-rel-pos");
    desk.until(A, "holding", 4000);
    desk.step(500);
    let position = desk.position(A);
    assert!((718..=722).contains(&position), "{position}");
}

#[test]
fn a_relative_move_by_nothing_is_a_stop() {
    let mut desk = Desk::new();
    desk.put(&format!("{B}stop_action"), "hold");
    desk.run(B, &[("speed_sp", 300)], "run-forever");
    desk.step(200);
    desk.run(B, &[("position_sp", 0)], "run-to-rel-pos");
    assert_eq!(desk.state(B), "holding");
}

#[test]
fn writing_the_position_ends_a_move_and_drives_a_held_motor_through_the_difference() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}stop_action"), "hold");
    desk.run(A, &[("speed_sp", 300), ("position_sp", 5000)], "run-to-abs-pos");
    desk.step(500);
    desk.put(&format!("{A}position"), 0);
    assert_eq!(desk.state(A), "running");
    desk.step(2);
    assert!(desk.state(A).starts_with("holding"), "{}", desk.state(A));
    desk.step(1000);
    assert!(desk.position(A).abs() <= 2);
    desk.put(&format!("{A}position"), -90);
    desk.step(1000);
    assert!(desk.position(A).abs() <= 2, "turned back to 0: {}", desk.position(A));
    let turned = desk.0.shaft_angle(Port::OutA);
    desk.run(A, &[("speed_sp", 300)], "run-forever");
    desk.step(100);
    desk.put(&format!("{A}position"), 0);
    desk.step(100);
    assert_eq!(desk.state(A), "running", "elsewhere only the numbers change");
    assert!(desk.0.shaft_angle(Port::OutA) > turned + 20.0);
}

#[test]
fn polarity_flips_numbers_and_not_what_is_stored() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}speed_sp"), 300);
    desk.put(&format!("{A}polarity"), "inversed");
    assert_eq!(desk.number(&format!("{A}speed_sp")), -300);
    desk.run(A, &[], "run-forever");
    desk.step(500);
    assert!(desk.speed(A) < -250 && desk.position(A) < -50);
    assert!(desk.number(&format!("{A}duty_cycle")) < 0);
    assert!(desk.0.shaft_angle(Port::OutA) > 50.0, "the same physical way");
    desk.run(A, &[("speed_sp", 300)], "run-forever");
    desk.step(500);
    assert!(desk.speed(A) > 250 && desk.0.shaft_angle(Port::OutA) < 100.0);
}

#[test]
fn ramps_walk_up_and_down() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}ramp_up_sp"), 2000);
    desk.put(&format!("{A}ramp_down_sp"), 1000);
    desk.run(A, &[("speed_sp", 780)], "run-forever");
    assert_eq!(desk.state(A), "running ramping");
    desk.step(500);
    let speed = desk.speed(A);
    assert!((300..600).contains(&speed), "half way: {speed}");
    // 2000 ms for 1560 counts/s, so 1000 ms for these 780, less 50 ms; then one step more. The
    // regulator's lead over the setpoint makes no difference to that.
    let rest = desk.until(A, "running", 1000);
    assert!((510..=560).contains(&rest), "{rest}");
    desk.step(1000);
    desk.put(&format!("{A}stop_action"), "brake");
    desk.run(A, &[], "stop");
    assert_eq!(desk.state(A), "running ramping", "still running after stop");
    let down = desk.until(A, "", 1000);
    assert!((510..=560).contains(&down), "{down}");
}

#[test]
fn a_stop_with_only_a_ramp_up_takes_50_ms_and_none_at_rest() {
    let mut desk = Desk::new();
    desk.run(A, &[("speed_sp", 500)], "run-forever");
    desk.step(1000);
    desk.run(A, &[("ramp_up_sp", 100)], "stop");
    assert!(desk.state(A).starts_with("running"));
    let took = desk.until(A, "", 200);
    assert!((50..=60).contains(&took), "{took}");
    desk.step(3000);
    desk.run(A, &[], "stop");
    assert_eq!(desk.state(A), "");
}

#[test]
fn with_ramps_a_run_at_speed_0_from_rest_does_nothing_at_all() {
    let mut desk = Desk::new();
    desk.run(A, &[("ramp_up_sp", 500), ("speed_sp", 0)], "run-forever");
    assert_eq!(desk.state(A), "");
    desk.run(A, &[("position_sp", 100)], "run-to-abs-pos");
    assert_eq!(desk.state(A), "");
}

#[test]
fn a_ramp_that_is_cut_short_leaves_its_flag() {
    let mut desk = Desk::new();
    desk.run(A, &[("ramp_up_sp", 5000), ("speed_sp", 1000), ("position_sp", 20)], "run-to-abs-pos");
    assert_eq!(desk.state(A), "running ramping");
    desk.until(A, "ramping", 3000);
    desk.step(1000);
    assert_eq!(desk.state(A), "ramping");
    desk.run(A, &[("ramp_up_sp", 100), ("speed_sp", 300)], "run-forever");
    desk.until(A, "running", 2000);
}

#[test]
fn a_short_timed_run_with_a_long_ramp_up_restarts_and_then_stops() {
    let mut desk = Desk::new();
    desk.run(A, &[("ramp_up_sp", 1000), ("speed_sp", 1500), ("time_sp", 300)], "run-timed");
    desk.step(308);
    assert!(desk.state(A).starts_with("running ramping"));
    desk.step(4);
    assert!(!desk.state(A).contains("running"), "{}", desk.state(A));
    desk.step(60);
    assert!(desk.state(A).starts_with("running ramping"), "restarted: {}", desk.state(A));
    desk.until(A, "", 2000);
}

#[test]
fn a_position_move_with_a_ramp_down_brakes_before_its_target() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}stop_action"), "coast");
    desk.run(
        A,
        &[("ramp_down_sp", 800), ("speed_sp", 800), ("position_sp", 1000)],
        "run-to-abs-pos",
    );
    desk.step(700);
    assert_eq!(desk.state(A), "running");
    desk.until(A, "running ramping", 2000);
    assert!(desk.position(A) < 960);
    desk.until(A, "", 3000);
    desk.step(1000);
    let position = desk.position(A);
    assert!((1000..1030).contains(&position), "hardly overshoots: {position}");
}

#[test]
fn state_notifies_on_the_60_ms_grid() {
    let mut desk = Desk::new();
    let mut file = Descriptor::open(&desk.0, &format!("{B}state"), Access::ReadOnly).unwrap();
    assert!(file.poll(&desk.0), "never read");
    let mut buffer = [0; 64];
    file.pread(&mut desk.0, 0, &mut buffer).unwrap();
    assert!(!file.poll(&desk.0));
    desk.step(10);
    desk.run(B, &[("speed_sp", 300), ("time_sp", 120)], "run-timed");
    desk.step(48);
    assert!(!file.poll(&desk.0), "not before the grid");
    desk.step(2);
    assert!(file.poll(&desk.0), "started");
    let length = file.pread(&mut desk.0, 0, &mut buffer).unwrap();
    assert_eq!(&buffer[..length], b"running\n");
    assert!(!file.poll(&desk.0));
    desk.step(118);
    assert!(!file.poll(&desk.0));
    desk.step(2);
    assert!(file.poll(&desk.0), "ended");
    // A run between two ticks of the grid is never notified.
    file.pread(&mut desk.0, 0, &mut buffer).unwrap();
    desk.step(5);
    desk.run(B, &[("time_sp", 20)], "run-timed");
    desk.step(40);
    assert_eq!(desk.state(B), "");
    desk.step(100);
    assert!(!file.poll(&desk.0));
}

#[test]
fn the_medium_and_the_nxt_motor_have_their_own_figures() {
    let mut desk = Desk::new();
    assert_eq!(desk.number(&format!("{A}max_speed")), 1560);
    assert_eq!(desk.number(&format!("{A}hold_pid/Kp")), 160_000);
    assert_eq!(desk.try_put(&format!("{A}speed_sp"), "1561"), Err(Errno::EINVAL));
    desk.put("lego-port/port5/set_device", "lego-nxt-motor");
    assert_eq!(desk.get("tacho-motor/motor3/driver_name"), "lego-nxt-motor");
    assert_eq!(desk.number("tacho-motor/motor3/max_speed"), 1020);
}

/// A motor that turns at about 300, with ramps of half a second at full speed.
fn turning(speed: i32, ms: u64) -> Desk {
    let mut desk = Desk::new();
    desk.put(&format!("{A}stop_action"), "brake");
    desk.run(A, &[("speed_sp", speed)], "run-forever");
    desk.step(ms);
    desk.put(&format!("{A}ramp_up_sp"), 500);
    desk.put(&format!("{A}ramp_down_sp"), 500);
    desk
}

#[test]
fn a_ramped_move_back_at_the_very_speed_that_is_measured_is_ignored() {
    let (mut ignored, mut obeyed) = (0, 0);
    for phase in 0..20 {
        let mut desk = turning(300, 1000 + phase * 2);
        let measured = desk.speed(A);
        let target = desk.position(A) - 200;
        desk.run(A, &[("speed_sp", 300), ("position_sp", target)], "run-to-abs-pos");
        desk.step(2);
        let setpoint_changed = desk.state(A) != "running";
        desk.step(3000);
        if measured == 300 {
            ignored += 1;
            assert!(!setpoint_changed && desk.state(A) == "running", "runs on forever");
            assert!(desk.position(A) > target + 900);
        } else {
            obeyed += 1;
            assert!((target - 60..=target).contains(&desk.position(A)), "{}", desk.position(A));
        }
    }
    assert!(ignored > 2 && obeyed > 2, "{ignored} ignored, {obeyed} not");
}

#[test]
fn a_ramped_move_back_with_the_sign_of_its_direction_is_never_ignored() {
    for phase in 0..20 {
        let mut desk = turning(300, 1000 + phase * 2);
        let target = desk.position(A) - 200;
        desk.run(A, &[("speed_sp", -300), ("position_sp", target)], "run-to-abs-pos");
        desk.step(5000);
        assert!((target - 60..=target).contains(&desk.position(A)), "{}", desk.position(A));
    }
}

#[test]
fn turning_backward_with_a_positive_speed_a_ramped_move_stops_first() {
    for phase in 0..10 {
        let mut desk = turning(-300, 1000 + phase * 2);
        let target = desk.position(A) - 400;
        desk.run(A, &[("speed_sp", 300), ("position_sp", target)], "run-to-abs-pos");
        assert_eq!(desk.state(A), "running ramping");
        let mut slowest = -300;
        while desk.state(A).contains("running") {
            desk.step(2);
            if desk.position(A) > target + 250 {
                slowest = slowest.max(desk.speed(A));
            }
        }
        assert!(slowest > -100, "slowed down to {slowest}");
        assert!((target - 60..=target).contains(&desk.position(A)));
    }
}

#[test]
fn a_relative_move_by_nothing_with_a_ramp_down_ends_at_the_next_sample() {
    let mut desk = turning(300, 1000);
    desk.put(&format!("{A}stop_action"), "hold");
    desk.run(A, &[("position_sp", 0)], "run-to-rel-pos");
    assert_eq!(desk.state(A), "running ramping");
    desk.step(2);
    assert_eq!(desk.state(A), "ramping holding", "and the flag stays");
    // With the stale flag the ramp begins where the last one ended, which is where it is to go.
    desk.run(A, &[("speed_sp", 0)], "run-forever");
    assert_eq!(desk.state(A), "holding", "ignored");
}

#[test]
fn the_flag_of_a_deceleration_shows_only_while_running() {
    let mut desk = Desk::new();
    let set = [("ramp_down_sp", 2000), ("speed_sp", 800), ("position_sp", 1000)];
    desk.run(A, &set, "run-to-abs-pos");
    desk.until(A, "running", 500);
    desk.until(A, "running ramping", 3000);
    desk.put(&format!("{A}ramp_down_sp"), 0);
    desk.run(A, &[], "stop");
    assert_eq!(desk.state(A), "");
    desk.run(A, &[("speed_sp", 100)], "run-forever");
    assert_eq!(desk.state(A), "running ramping", "and it is still there");
}

#[test]
fn a_leg_without_length_is_done_in_one_step_and_shows_no_ramp() {
    let mut desk = Desk::new();
    desk.run(A, &[("ramp_down_sp", 500), ("speed_sp", 500)], "run-forever");
    assert_eq!(desk.state(A), "running");
    desk.step(1000);
    assert!(desk.speed(A) > 450);
}

#[test]
fn steps_of_a_ramp_are_60_and_50_ms_apart() {
    let mut desk = Desk::new();
    let duty = format!("{A}duty_cycle");
    desk.0.jam(Port::OutA, true);
    desk.put(&format!("{A}speed_pid/Ki"), 0);
    desk.run(A, &[("ramp_up_sp", 2000), ("speed_sp", 1000)], "run-forever");
    let (mut before, mut steps) = (0, vec![]);
    for tick in 1..200 {
        desk.step(2);
        let now = desk.number(&duty);
        if now != before {
            steps.push(tick * 2);
        }
        before = now;
    }
    let gaps: Vec<u64> = steps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert_eq!(gaps[1..5], [50, 60, 50, 60], "{steps:?}");
}

#[test]
fn a_stop_that_holds_leaves_the_bridge_until_the_regulator_differs() {
    let mut desk = turning(300, 1500);
    desk.put(&format!("{A}ramp_up_sp"), 0);
    desk.put(&format!("{A}ramp_down_sp"), 0);
    desk.put(&format!("{A}stop_action"), "hold");
    desk.run(A, &[], "stop");
    assert_eq!(desk.number(&format!("{A}duty_cycle")), 0);
    let at = desk.0.shaft_angle(Port::OutA);
    desk.step(2);
    let gone = desk.0.shaft_angle(Port::OutA) - at;
    assert!(gone > 0.55, "still driven: {gone}");
    desk.step(500);
    let off = desk.0.shaft_angle(Port::OutA) - at;
    assert!(off.abs() < 3.0, "{off}");
}

#[test]
fn a_run_at_speed_0_leaves_a_coasting_bridge_alone() {
    let far = |action: &str| {
        let mut desk = turning(300, 1500);
        desk.put(&format!("{A}ramp_up_sp"), 0);
        desk.put(&format!("{A}ramp_down_sp"), 0);
        desk.put(&format!("{A}stop_action"), action);
        desk.run(A, &[], "stop");
        let at = desk.position(A);
        desk.run(A, &[("speed_sp", 0)], "run-forever");
        desk.step(2000);
        assert_eq!(desk.state(A), "running stalled");
        desk.position(A) - at
    };
    assert!(far("coast") > far("brake") + 2);
}

#[test]
fn numbers_are_texts_of_c_and_limits_are_of_32_bits() {
    let mut desk = Desk::new();
    desk.put(&format!("{A}speed_sp"), "300\0 and more");
    assert_eq!(desk.number(&format!("{A}speed_sp")), 300);
    desk.put(&format!("{A}command"), "run-forever\n\0x");
    assert_eq!(desk.state(A), "running");
    desk.put(&format!("{A}speed_sp"), i32::MIN);
    assert_eq!(desk.number(&format!("{A}speed_sp")), i32::MIN);
    assert_eq!(desk.try_put(&format!("{A}speed_sp"), "-2147483647"), Err(Errno::EINVAL));
}

/// A free motor that is sent to a speed from rest: how long until 90 % of it is read, in ms, and
/// the most that is read, in per mille.
fn step_response(driver: &str, speed: i32, rested_ms: u64) -> (u64, i32) {
    let mut desk = Desk::new();
    desk.0.plug(Port::OutD, driver).unwrap();
    desk.step(1000 + rested_ms);
    let motor = "tacho-motor/motor3/";
    desk.run(motor, &[("speed_sp", speed)], "run-forever");
    let (mut reached, mut most) = (None, 0);
    for tick in 1..500 {
        desk.step(2);
        let now = desk.speed(motor);
        if now * 10 >= speed * 9 {
            reached = reached.or(Some(tick * 2));
        }
        most = most.max(now);
    }
    (reached.unwrap(), most * 1000 / speed)
}

#[test]
fn the_stamps_made_at_rest_make_a_start_look_slow_and_so_it_is_harder() {
    for rested in [0, 30] {
        // 80 ms and 1.1 without stamps at rest.
        let (reached, _) = step_response("lego-ev3-m-motor", 1000, rested);
        assert!((88..112).contains(&reached), "{reached} ms");
        let (_, most) = step_response("lego-ev3-l-motor", 500, rested);
        assert!((1110..1130).contains(&most), "{most}");
    }
}

/// The timers of a jiffy run in the order in which the wheel has them: the look at the flags,
/// which was set later, comes before the end of a timed run, and sees it one look later.
#[test]
fn a_run_that_ends_in_a_jiffy_of_the_look_at_the_flags_wakes_60_ms_later() {
    for (time, start, stops, wakes) in
        [(110, 0, 120, 180), (133, 30, 180, 240), (500, 90, 600, 660)]
    {
        let mut desk = Desk::new();
        desk.step(start);
        desk.put(&format!("{B}speed_sp"), 300);
        desk.put(&format!("{B}time_sp"), time);
        desk.put(&format!("{B}command"), "run-timed");
        let node = desk.0.open(&format!("{B}state"), Access::ReadOnly).unwrap();
        let (mut stopped, mut woken) = (0, 0);
        for now in (start + 2..1000).step_by(2) {
            let before = desk.0.event_count(node).unwrap();
            desk.step(2);
            if desk.0.event_count(node).unwrap() != before {
                woken = now;
            }
            if stopped == 0 && desk.get(&format!("{B}state")).is_empty() {
                stopped = now;
            }
        }
        assert_eq!((stopped, woken), (stops, wakes), "{time} ms from {start} ms on");
    }
}

/// The kernel's numbers have 32 bits: one that is accepted and overflows in the arithmetic of a
/// ramp makes the motor turn elsewhere.
#[test]
fn a_ramp_to_the_smallest_number_overflows() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", -200)], "run-forever");
    desk.step(1500);
    assert_eq!(desk.speed(B), -200);
    let set = [("ramp_up_sp", 10), ("ramp_down_sp", 10), ("speed_sp", i32::MIN)];
    desk.run(B, &set, "run-forever");
    desk.step(2);
    assert_eq!(desk.state(B), "running ramping");
    let duty = desk.number(&format!("{B}duty_cycle"));
    assert!((80..=90).contains(&duty), "{duty}: ahead, not back");
}

#[test]
fn an_end_stop_stalls_in_its_direction_only_also_without_wheels() {
    let motor = Fact::Motor(MotorMount {
        port: Port::OutA,
        driver: "lego-ev3-m-motor".into(),
        noise: None,
        encoder_noise: None,
        stops: Some([-30.0, 90.0]),
    });
    let robot = RobotSpec::from_facts(&[motor]).unwrap();
    let mut desk = Desk::with(&WorldSpec::default(), &robot);
    for (duty, end) in [(50, 90.0), (-50, -30.0), (50, 90.0)] {
        desk.run(A, &[("duty_cycle_sp", duty)], "run-direct");
        desk.step(1000);
        assert_eq!(desk.0.shaft_angle(Port::OutA).to_bits(), f64::to_bits(end), "{duty}");
        assert!(desk.0.kinetic_energy() <= 0.0);
        assert_eq!(desk.state(A), "running stalled");
    }
    assert_eq!(desk.0.pose(), Pose::default(), "nothing drives");
}
