//! Waiting, and why a wait ends.
use crate::brick::{Brick, motors, ms};
use ev3_driver::motor::wait::{Reason, until_flag, wait_for};
use ev3_driver::motor::{
    Extent, Move, MoveOptions, Run, Speed, StopAction, command, run_forever, run_to, stop,
};
use ev3_driver::sysfs::sleep;
use ev3_driver::{Error, Registry};
use std::sync::Arc;
use std::time::Duration;

/// Starts a move of some motors at half speed.
fn start(devices: &Arc<Registry>, ports: &[&str], degrees: f64) {
    let speed = Speed::Percent(50.0);
    let moves: Vec<_> =
        ports.iter().map(|port| Move { port, speed, extent: Extent::By(degrees) }).collect();
    let options = MoveOptions { wait: false, ..MoveOptions::default() };
    run_to(devices, &moves, &options, &mut || false).unwrap().unwrap();
}

/// Waits for some motors, with a time limit that a working wait does not need.
fn wait(brick: &Arc<Brick>, devices: &Arc<Registry>, ports: &[&str]) -> Reason {
    let all = motors(devices, ports);
    wait_for(devices, &all, Some(Duration::from_secs(60)), &mut brick.attentive()).unwrap()
}

#[test]
fn each_reason_has_a_word_of_its_own() {
    let reasons =
        [Reason::Reached, Reason::Stalled, Reason::Timeout, Reason::Unplugged, Reason::Stopped];
    let words = ["reached", "stalled", "timeout", "unplugged", "stopped"];
    assert_eq!(reasons.map(Reason::word), words);
}

#[test]
fn a_wait_for_no_motor_or_one_at_rest_is_over_at_once() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    assert_eq!(wait(&brick, &devices, &[]), Reason::Reached);
    assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Reached);
    assert!(brick.now() < ms(1), "waited until {:?}", brick.now());
}

#[test]
fn a_wait_lasts_until_the_last_motor_is_done_and_hardly_longer() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB"]);
    start(&devices, &["outA"], 100.0);
    start(&devices, &["outB"], 1000.0);
    assert_eq!(wait(&brick, &devices, &["outA", "outB"]), Reason::Reached);
    // 1000 counts at 525 counts/s, and 30 ms of lag.
    let expected = ms(1935);
    assert!(brick.now() >= expected && brick.now() < expected + ms(15), "{:?}", brick.now());
}

#[test]
fn a_wait_ends_as_soon_where_no_change_is_announced() {
    for (notifies, always_ready) in [(true, false), (false, false), (true, true)] {
        let brick = Brick::new(&["outA"]);
        brick.world().notifies = notifies;
        brick.world().always_ready = always_ready;
        let devices = brick.devices();
        start(&devices, &["outA"], 1000.0);
        assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Reached);
        assert!(brick.now() < ms(1950), "{:?}", brick.now());
        assert!(brick.pauses() < 250, "{} pauses", brick.pauses());
    }
}

#[test]
fn a_state_that_is_told_late_does_not_end_the_wait_early() {
    for degrees in [20.0, 100.0, 1000.0, -1000.0] {
        let brick = Brick::new(&["outA"]);
        brick.world().motor("outA").state_lag = ms(60);
        brick.world().motor("outA").tells_speed = false;
        let devices = brick.devices();
        for turns in 1..4 {
            start(&devices, &["outA"], degrees);
            assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Reached);
            #[expect(clippy::cast_possible_truncation, reason = "angles are small")]
            let left = degrees as i64 * turns - brick.world().motor("outA").counts();
            assert!(left.abs() <= 15, "{left} left of {degrees} at turn {turns}");
        }
    }
}

#[test]
fn a_motor_that_flags_a_stall_at_each_start_is_not_blocked() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").stalls_after = Some(ms(0));
    brick.world().motor("outA").sticks_for = ms(70);
    let devices = brick.devices();
    start(&devices, &["outA"], 300.0);
    assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Reached);
}

#[test]
fn a_slow_motor_takes_longer_to_break_away_and_is_not_blocked() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").sticks_for = ms(400);
    let devices = brick.devices();
    let turn = Move { port: "outA", speed: Speed::Percent(2.0), extent: Extent::By(20.0) };
    let ended = run_to(&devices, &[turn], &MoveOptions::default(), &mut brick.attentive());
    assert_eq!(ended.unwrap(), Some(Reason::Reached));
}

#[test]
fn a_slow_motor_that_is_blocked_is_noticed() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").is_blocked = true;
    let devices = brick.devices();
    let turn = Move { port: "outA", speed: Speed::Percent(2.0), extent: Extent::By(20.0) };
    let ended = run_to(&devices, &[turn], &MoveOptions::default(), &mut brick.attentive());
    assert_eq!(ended.unwrap(), Some(Reason::Stalled));
    assert!(brick.now() < ms(700), "{:?}", brick.now());
}

#[test]
fn a_blocked_motor_ends_the_wait_for_all() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB"]);
    start(&devices, &["outA", "outB"], 3000.0);
    brick.at(ms(500), |world| world.motor("outB").is_blocked = true);
    assert_eq!(wait(&brick, &devices, &["outA", "outB"]), Reason::Stalled);
    assert!(brick.now() < ms(800), "{:?}", brick.now());
}

#[test]
fn a_blocked_motor_is_noticed_where_the_board_flags_no_stall() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").stalls_after = None;
    let devices = brick.devices();
    start(&devices, &["outA"], 3000.0);
    brick.at(ms(500), |world| world.motor("outA").is_blocked = true);
    assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Stalled);
    assert!(brick.now() < ms(2600), "{:?}", brick.now());
}

#[test]
fn a_motor_that_runs_for_ever_is_waited_for_until_the_time_is_up() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let run = Run { port: "outA", speed: Speed::Percent(30.0) };
    run_forever(&devices, &[run], &mut || false).unwrap();
    let all = motors(&devices, &["outA"]);
    let started = brick.now();
    let timeout = Some(ms(250));
    let reason = wait_for(&devices, &all, timeout, &mut brick.attentive()).unwrap();
    assert_eq!(reason, Reason::Timeout);
    let waited = brick.since(started);
    assert!(waited >= ms(250) && waited < ms(255), "{waited:?}");
    assert!(brick.world().motor("outA").is_powered(), "a wait stops nothing");
}

#[test]
fn no_time_at_all_is_one_look() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    start(&devices, &["outA"], 1000.0);
    let all = motors(&devices, &["outA"]);
    let look = |brick: &Arc<Brick>| {
        wait_for(&devices, &all, Some(Duration::ZERO), &mut brick.attentive()).unwrap()
    };
    assert_eq!(look(&brick), Reason::Timeout);
    brick.pass(ms(3000));
    assert_eq!(look(&brick), Reason::Reached);
}

#[test]
fn an_unplugged_motor_ends_the_wait() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB"]);
    start(&devices, &["outA", "outB"], 3000.0);
    brick.at(ms(500), |world| world.motor("outB").is_unplugged = true);
    assert_eq!(wait(&brick, &devices, &["outA", "outB"]), Reason::Unplugged);
    assert!(brick.now() < ms(630), "{:?}", brick.now());
}

#[test]
fn a_motor_that_somebody_else_stops_is_stopped_not_there() {
    let devices = Brick::new(&["outA"]).devices();
    let all = motors(&devices, &["outA"]);
    start(&devices, &["outA"], 3000.0);
    let mut asked = 0;
    let reason = wait_for(&devices, &all, None, &mut || {
        asked += 1;
        if asked == 10 {
            // As another thread would.
            stop(&all[0], StopAction::Brake).unwrap();
        }
        false
    });
    assert_eq!(reason.unwrap(), Reason::Stopped);
}

#[test]
fn a_motor_that_another_program_stops_is_stopped_not_there() {
    let devices = Brick::new(&["outA"]).devices();
    let all = motors(&devices, &["outA"]);
    start(&devices, &["outA"], 3000.0);
    let mut asked = 0;
    let reason = wait_for(&devices, &all, None, &mut || {
        asked += 1;
        if asked == 10 {
            all[0].write("command", "stop").unwrap();
        }
        false
    });
    assert_eq!(reason.unwrap(), Reason::Stopped);
}

#[test]
fn a_timed_run_that_is_stopped_before_its_time_is_stopped() {
    for (stop_at, expected) in [(ms(100), Reason::Stopped), (ms(600), Reason::Reached)] {
        let (brick, devices) = Brick::with_devices(&["outA"]);
        let all = motors(&devices, &["outA"]);
        all[0].write("speed_sp", "500").unwrap();
        all[0].write("time_sp", "500").unwrap();
        command(&all[0], "run-timed").unwrap();
        let reason = wait_for(&devices, &all, None, &mut || {
            if brick.now() >= stop_at {
                all[0].write("command", "stop").unwrap();
            }
            false
        });
        assert_eq!(reason.unwrap(), expected);
    }
}

#[test]
fn a_motor_may_end_ten_counts_short_of_its_target() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").ends_short = 10;
    let devices = brick.devices();
    start(&devices, &["outA"], 300.0);
    assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Reached);
}

#[test]
fn a_board_that_shows_holding_together_with_running_is_done_when_it_is_there() {
    // NXTMMX and PiStorms, which report no speed either.
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").runs_while_holding = true;
    brick.world().motor("outA").tells_speed = false;
    brick.world().motor("outA").state_lag = ms(20);
    let devices = brick.devices();
    for _ in 0..2 {
        let started = brick.now();
        start(&devices, &["outA"], 300.0);
        assert_eq!(wait(&brick, &devices, &["outA"]), Reason::Reached);
        assert!(brick.since(started) < ms(800), "{:?}", brick.since(started));
    }
}

#[test]
fn a_wait_can_be_interrupted_within_20_ms() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    start(&devices, &["outA"], 3000.0);
    let all = motors(&devices, &["outA"]);
    let started = brick.now();
    let error = wait_for(&devices, &all, None, &mut brick.interrupting(ms(100))).unwrap_err();
    assert!(matches!(error, Error::Interrupted));
    assert!(brick.since(started) <= ms(122));
}

#[test]
fn absurd_times_are_long_and_no_more() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    start(&devices, &["outA"], 300.0);
    let all = motors(&devices, &["outA"]);
    let reason = wait_for(&devices, &all, Some(Duration::MAX), &mut brick.attentive()).unwrap();
    assert_eq!(reason, Reason::Reached);
    let slept = sleep(devices.tree(), Duration::MAX, &mut brick.interrupting(ms(100)));
    assert!(matches!(slept, Err(Error::Interrupted)));
}

#[test]
fn a_sleep_lasts_as_long_as_asked_and_asks_as_often_as_a_wait() {
    let (brick, devices) = Brick::with_devices(&[]);
    for time in [ms(0), ms(1), ms(7), ms(20), ms(333)] {
        let started = brick.now();
        sleep(devices.tree(), time, &mut brick.attentive()).unwrap();
        assert_eq!(brick.since(started), time);
    }
}

#[test]
fn a_flag_is_waited_for_until_it_is_there() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let motor = &motors(&devices, &["outA"])[0];
    start(&devices, &["outA"], 300.0);
    until_flag(&devices, motor, "holding", true).block(&mut brick.attentive()).unwrap();
    let done = brick.now();
    assert!(done > ms(500) && done < ms(650), "{done:?}");
    until_flag(&devices, motor, "running", false).block(&mut brick.attentive()).unwrap();
    assert!(brick.since(done) < ms(1));
}

#[test]
fn the_end_of_running_is_not_seen_before_its_beginning() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").state_lag = ms(60);
    let devices = brick.devices();
    let motor = &motors(&devices, &["outA"])[0];
    start(&devices, &["outA"], 500.0);
    until_flag(&devices, motor, "running", false).block(&mut brick.attentive()).unwrap();
    let position = brick.world().motor("outA").counts();
    assert!((position - 500).abs() < 15, "at {position}");
}

#[test]
fn a_run_that_was_seen_and_is_over_is_not_waited_for_any_longer() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let motor = &motors(&devices, &["outA"])[0];
    motor.write("speed_sp", "500").unwrap();
    motor.write("time_sp", "40").unwrap();
    command(motor, "run-timed").unwrap();
    until_flag(&devices, motor, "running", false).block(&mut brick.attentive()).unwrap();
    assert!(brick.now() < ms(50), "{:?}", brick.now());
}

#[test]
fn a_command_that_never_shows_as_running_is_given_100_ms() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let motor = &motors(&devices, &["outA"])[0];
    command(motor, "run-forever").unwrap();
    motor.write("command", "stop").unwrap();
    let started = brick.now();
    until_flag(&devices, motor, "running", false).block(&mut brick.attentive()).unwrap();
    let waited = brick.since(started);
    assert!(waited > ms(90) && waited < ms(125), "{waited:?}");
}

#[test]
fn a_flag_of_an_unplugged_motor_is_an_error_that_names_it() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let motor = &motors(&devices, &["outA"])[0];
    brick.at(ms(200), |world| world.motor("outA").is_unplugged = true);
    let error = until_flag(&devices, motor, "stalled", true).block(&mut brick.attentive());
    assert!(matches!(error, Err(Error::Unplugged { port, .. }) if port == "outA"));
}
