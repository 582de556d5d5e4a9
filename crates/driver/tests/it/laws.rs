//! Laws that hold for every text and every number.
use crate::brick::Brick;
use ev3_driver::motor::Speed;
use ev3_driver::value::{first_line, integer};
use ev3_driver::{Class, Value, port_name};
use proptest::prelude::*;
use std::cmp::Ordering;

/// Names with a bias to what ports are made of.
fn port_name() -> impl Strategy<Value = String> {
    prop_oneof!["[a-c]?[0-9]{0,3}(:[a-b][0-9]{0,2}){0,2}", ".{0,6}"]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn every_integer_is_read_as_what_it_was_written(number: i64) {
        prop_assert_eq!(integer(number.to_string().as_bytes()), Some(number));
        prop_assert_eq!(Value::parse(number.to_string()), Value::Integer(number));
    }

    #[test]
    fn an_integer_is_what_rust_takes_for_one(text in "[-+]?[0-9 a]{0,21}") {
        prop_assert_eq!(integer(text.as_bytes()), text.parse().ok());
    }

    #[test]
    fn a_text_is_a_finite_number_or_stays_what_it_is(
        text in prop_oneof![".*", "[-+]?[0-9]{0,4}[.]?[0-9]{0,4}", "[0-9]{300,320}[.][0-9]"]
    ) {
        match Value::parse(text.clone()) {
            Value::Integer(number) => prop_assert_eq!(text.parse(), Ok(number)),
            Value::Float(number) => {
                prop_assert!(number.is_finite());
                prop_assert_eq!(text.parse(), Ok(number));
                prop_assert!(text.contains('.'));
            }
            Value::Text(same) => prop_assert_eq!(same, text),
        }
    }

    #[test]
    fn scaling_is_total(value: i64, decimals: i64) {
        match Value::scaled(value, decimals) {
            Value::Integer(same) => prop_assert_eq!(same, value),
            Value::Float(_) => prop_assert_ne!(decimals, 0),
            Value::Text(text) => prop_assert!(false, "{}", text),
        }
    }

    #[test]
    fn scaling_by_few_decimals_gives_the_nearest_float(value: i32, decimals in 1_u32..10) {
        let whole = i64::from(value);
        let exact: f64 = format!("{whole}e-{decimals}").parse().unwrap();
        prop_assert_eq!(Value::scaled(whole, i64::from(decimals)), Value::Float(exact));
    }

    #[test]
    fn the_first_line_has_no_newline_and_begins_the_text(bytes: Vec<u8>) {
        let line = first_line(&bytes);
        prop_assert!(bytes.starts_with(line) && !line.contains(&b'\n'));
        prop_assert!(bytes.len() == line.len() || bytes[line.len()] == b'\n');
    }

    #[test]
    fn ports_are_totally_ordered(a in port_name(), b in port_name(), c in port_name()) {
        prop_assert_eq!(port_name::order(&a, &b), port_name::order(&b, &a).reverse());
        prop_assert_eq!(port_name::order(&a, &b) == Ordering::Equal, a == b);
        let mut sorted = [&*a, &*b, &*c];
        sorted.sort_by(|a, b| port_name::order(a, b));
        for (first, second) in [(0, 1), (1, 2), (0, 2)] {
            prop_assert_ne!(port_name::order(sorted[first], sorted[second]), Ordering::Greater);
        }
    }

    #[test]
    fn ports_with_numbers_are_in_the_order_of_their_numbers(a: u32, b: u32) {
        prop_assert_eq!(port_name::order(&format!("S{a}"), &format!("S{b}")), a.cmp(&b));
    }

    #[test]
    fn a_short_name_has_none_shorter(name in port_name()) {
        for board in ["", "ev3-ports:", "evb-ports:"] {
            let long = format!("{board}{name}");
            prop_assert_eq!(port_name::short(&long), &*name);
        }
    }

    #[test]
    fn no_speed_is_beyond_max_speed(
        max_speed in prop_oneof![0_i64..3000, any::<i64>()],
        speed in prop_oneof![
            (-110.0..110.0).prop_map(Speed::Percent),
            any::<f64>().prop_map(Speed::Percent),
            any::<i64>().prop_map(Speed::CountsPerSecond),
        ],
    ) {
        let brick = Brick::new(&["outA"]);
        brick.world().motor("outA").max_speed = max_speed;
        let motor = brick.devices().find(Class::TachoMotor, "outA").unwrap().unwrap();
        if let Some(counts) = speed.in_counts(&motor).unwrap() {
            prop_assert!(counts.unsigned_abs() <= max_speed.unsigned_abs());
        }
    }
}
