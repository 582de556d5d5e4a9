//! The actions and observations of a person at the brick: buttons, tones, speech.
use crate::brick::panel::{Button, ButtonEvent};
use crate::machine::Machine;
use crate::ticks::TICK_US;
use crate::trace::Action;
use std::time::Duration;

/// How long speech takes, a letter; espeak says some 15 of them a second.
const LETTER: Duration = Duration::from_millis(65);

impl Machine {
    /// Presses a button, and holds it. The kernel reports it only if it was up.
    pub fn press(&mut self, button: Button) {
        self.set_button(ButtonEvent { at: self.now, button, is_press: true });
    }

    /// Releases a button.
    pub fn release(&mut self, button: Button) {
        self.set_button(ButtonEvent { at: self.now, button, is_press: false });
    }

    /// Presses or releases a button after some virtual time.
    pub fn plan_button(&mut self, button: Button, is_press: bool, after: Duration) {
        self.panel.plan(ButtonEvent { at: self.now.saturating_add(after), button, is_press });
    }

    /// True while the button is held.
    pub fn is_pressed(&self, button: Button) -> bool {
        self.panel.is_down(button)
    }

    /// How often a button was pressed or released.
    pub fn button_events(&self) -> u64 {
        self.panel.event_count
    }

    /// When a planned press or release is next due.
    pub fn next_button(&self) -> Option<Duration> {
        self.panel.next_planned()
    }

    fn set_button(&mut self, event: ButtonEvent) {
        if self.panel.set(event) {
            let action = if event.is_press { Action::Pressed } else { Action::Released };
            self.trace.event(event.at, action, None, event.button.to_string().as_bytes());
        }
    }

    /// Presses and releases what is planned until this tick.
    pub(super) fn apply_planned_buttons(&mut self) {
        if self.panel.next_planned().is_none() {
            return;
        }
        let now = Duration::from_micros(self.tick * TICK_US);
        while let Some(event) = self.panel.take_planned(now) {
            self.set_button(event);
        }
    }

    /// The present tone of the tone generator, in Hz; 0 is silence.
    pub fn tone(&self) -> u32 {
        self.panel.tone()
    }

    pub(super) fn set_tone(&mut self, hertz: i32) {
        self.panel.set_tone(hertz);
        self.record_sound(Action::Tone, &self.panel.tone().to_string());
    }

    /// A program says something. Returns how long that takes.
    pub fn say(&mut self, text: &str) -> Duration {
        self.record_sound(Action::Said, text);
        LETTER * u32::try_from(text.chars().count()).unwrap_or(u32::MAX)
    }

    /// A program plays a recording.
    pub fn play(&mut self, file: &str) {
        self.record_sound(Action::Played, file);
    }

    /// A program ends what it says or plays.
    pub fn silence(&mut self) {
        self.record_sound(Action::Silenced, "");
    }

    /// The volume of speech and recordings, in percent.
    pub fn volume(&self) -> u8 {
        self.panel.volume
    }

    /// Sets the volume, to 100 percent at most.
    pub fn set_volume(&mut self, percent: u8) {
        self.panel.volume = percent.min(100);
    }

    fn record_sound(&mut self, action: Action, text: &str) {
        self.trace.event(self.now, action, None, text.as_bytes());
    }
}
