//! Foreign library of the pack `ev3dev`: Prolog's view of [`ev3_driver`].
//!
//! A file here registers the native predicates of one Prolog module, or of a few that
//! belong together. Each predicate gets its arguments from their terms, calls the
//! driver once, and unifies the result. If the driver returns `None`, the predicate
//! fails. Only [`glue::error`] makes an ISO exception of an error.
//!
//! A native predicate `p_/M` is the twin of the public `p/N` of the Prolog
//! module, and names that in its errors.
#[macro_use]
mod glue;

mod battery;
mod bricks;
mod buttons;
mod dc_motors;
mod drive;
mod driver;
mod facts;
mod files;
mod grid;
mod halt;
mod journal;
mod lights;
mod localize;
mod motors;
mod navigation;
#[cfg(not(unix))]
mod none;
mod planner;
mod ports;
mod roadmap;
mod screen;
mod sensors;
mod servo_motors;
#[cfg(feature = "sim")]
mod sim;
#[cfg(not(feature = "sim"))]
#[path = "no_sim.rs"]
mod sim;
mod sound;
mod time;
mod view;

/// Registers all predicates; SWI-Prolog calls it when it loads the library.
// Safety: SWI-Prolog defines the name and looks it up in this library only.
#[unsafe(no_mangle)]
pub extern "C" fn install() {
    glue::interned::register();
    swipl::fli::answer_quickly("attribute_", 4, driver::known_attribute);
    swipl::fli::answer_quickly("sensor_known_", 3, sensors::known_value);
    swipl::fli::answer_quickly("motor_run_", 2, motors::known_run);
    bricks::register();
    driver::register();
    motors::register();
    dc_motors::register();
    servo_motors::register();
    halt::register();
    swipl::fli::act_at_halt(halt::halts);
    journal::register();
    lights::register();
    localize::register();
    battery::register();
    ports::register();
    sensors::register();
    files::register();
    time::register();
    buttons::register();
    sound::register();
    screen::register();
    grid::register();
    planner::register();
    roadmap::register();
    navigation::register();
    drive::register();
    view::register();
    view::door::register();
    view::frame::register();
    view::hand::register();
    view::located::register();
    #[cfg(feature = "sim")]
    {
        sim::register();
        sim::buttons::register();
        #[cfg(unix)]
        sim::fence::register();
        sim::limit::register();
    }
    #[cfg(not(unix))]
    none::register();
}

/// The same as a predicate of no argument, which a page's loader registers before Prolog starts.
// Safety: only the loader looks the name up.
#[cfg(target_family = "wasm")]
#[unsafe(no_mangle)]
pub extern "C" fn install_predicate() -> usize {
    // It ends here: nothing unwinds in WebAssembly.
    std::panic::set_hook(Box::new(|panic| ev3_os::page::say_to_page(&format!("! {panic}"))));
    install();
    1
}
