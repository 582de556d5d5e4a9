//! The paper's obstacle avoidance in a room with walls and boxes.
use crate::desk::{B, C, Desk, furnished};
use crate::robots::default_robot;

#[test]
fn two_minutes_without_a_collision() {
    let mut desk = Desk::with(&furnished(), &default_robot());
    for motor in [B, C] {
        desk.put(&format!("{motor}stop_action"), "hold");
    }
    let mut turns = 0;
    while desk.0.now().as_secs() < 120 {
        if desk.number("lego-sensor/sensor0/value0") > 500 {
            for motor in [B, C] {
                desk.run(motor, &[("speed_sp", 210)], "run-forever");
            }
            desk.step(10);
        } else {
            turns += 1;
            // 90 degrees of the robot are this many counts of a wheel.
            for (motor, counts) in [(B, 170), (C, -170)] {
                desk.run(motor, &[("speed_sp", 210), ("position_sp", counts)], "run-to-rel-pos");
            }
            desk.until(B, "holding", 5000);
            desk.until(C, "holding", 5000);
        }
    }
    assert_eq!(desk.0.trace().collision_count(), 0);
    assert!(turns > 5);
}
