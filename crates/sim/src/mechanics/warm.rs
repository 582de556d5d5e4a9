//! The start of a step among things: the impulses of the last one.
//!
//! Without it a heap needs hundreds of rounds, and light boxes that a robot pushes against a wall
//! creep. The impulses are a part of the state: a snapshot has them.

use crate::mechanics::limit::Touch;

/// The name of a contact from one step to the next: two bodies, or one and 0, and a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Key(pub(super) [u32; 3]);

/// The impulses of a body's last step, per second.
#[derive(Clone, Debug, Default)]
pub(super) struct Warm {
    /// Push and rub by contact. Of a contact of two bodies the first one knows them.
    contacts: Vec<(Key, [f64; 2])>,
    /// Shafts, tires and grips.
    pub(super) wheels: [f64; 5],
    /// The share of the floor's hold.
    pub(super) sole: [f64; 3],
}

impl Warm {
    pub(super) fn forget(&mut self) {
        *self = Warm::default();
    }

    /// Notes a contact that pushes.
    pub(super) fn note(&mut self, key: Key, touch: &Touch, seconds: f64) {
        if touch.push.impulse != 0.0 {
            let impulses = [&touch.push, &touch.rub].map(|limit| limit.impulse / seconds);
            self.contacts.push((key, impulses));
        }
    }

    /// The impulses at a contact: push and rub.
    pub(super) fn at(&self, key: Key, seconds: f64) -> Option<[f64; 2]> {
        let (_, impulses) = self.contacts.iter().find(|(other, _)| *other == key)?;
        Some(impulses.map(|impulse| impulse * seconds))
    }
}
