//! The film of a run, taken and shown.
use crate::brick::port::Port;
use crate::machine::Machine;
use crate::machine::film::{Film, Sample, Values};
use crate::machine::tree::Hardware;
use crate::ticks::TICK_US;
use std::time::Duration;

impl Machine {
    /// Keeps samples from now on, or none.
    pub fn keep_samples(&mut self, keep: bool) {
        if !keep {
            self.film = None;
        } else if self.film.is_none() {
            self.film = Some(Film::new());
            self.take_sample();
        }
    }

    /// The samples after a moment, or all, oldest first.
    pub fn samples(&self, after: Option<Duration>) -> Vec<&Sample> {
        let is_new = |sample: &&Sample| after.is_none_or(|after| sample.at > after);
        let newest = self.film.iter().flat_map(|film| film.kept.newest());
        let mut samples: Vec<_> = newest.take_while(is_new).collect();
        samples.reverse();
        samples
    }

    /// A tick has passed.
    pub(crate) fn sample_at_tick(&mut self) {
        if self.film.as_ref().is_some_and(|film| self.tick % film.spacing == 0) {
            self.take_sample();
        }
    }

    fn take_sample(&mut self) {
        let at = Duration::from_micros(self.tick * TICK_US);
        let ports = Port::ALL.map(|port| match self.device(port) {
            Some(Hardware::Tacho(motor)) => {
                let shown = motor.shown();
                let all = [shown.position, shown.speed, shown.duty].map(f64::from);
                all.into_iter().chain(self.opening(port)).collect()
            }
            Some(Hardware::Sensor(sensor)) => self.shown_values(sensor).collect(),
            _ => Values::default(),
        });
        let things = self.things.iter().map(|thing| (thing.id, thing.pose())).collect();
        let sample = Sample { at, pose: self.body.pose, things, ports };
        if let Some(film) = &mut self.film {
            film.take(sample);
        }
    }
}
