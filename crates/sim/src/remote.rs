//! The remote control of the EV3 set: two red and two blue buttons, a button for the beacon, and
//! a switch for four channels.

/// How many channels there are.
pub(crate) const CHANNELS: usize = 4;

/// A button that is held down. The beacon's stays down until it is pressed again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// Upper left.
    RedUp,
    /// Lower left.
    RedDown,
    /// Upper right.
    BlueUp,
    /// Lower right.
    BlueDown,
    /// The grey one in the middle.
    Beacon,
}

/// What is held down on a channel: one button, or two that the sensor can tell from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Remote(u8);

/// In the order of the codes of the mode `IR-REMOTE`.
const CODES: [&[Button]; 12] = [
    &[],
    &[Button::RedUp],
    &[Button::RedDown],
    &[Button::BlueUp],
    &[Button::BlueDown],
    &[Button::RedUp, Button::BlueUp],
    &[Button::RedUp, Button::BlueDown],
    &[Button::RedDown, Button::BlueUp],
    &[Button::RedDown, Button::BlueDown],
    &[Button::Beacon],
    &[Button::RedUp, Button::RedDown],
    &[Button::BlueUp, Button::BlueDown],
];
/// What `IR-REM-A` shows with nothing pressed, what else its bits are, and which is whose.
const IDLE_BITS: i32 = 384;
const BASE_BITS: i32 = 256;
const BITS: [(Button, i32); 4] = [
    (Button::RedUp, 1 << 4),
    (Button::RedDown, 1 << 5),
    (Button::BlueUp, 1 << 6),
    (Button::BlueDown, 1 << 7),
];

impl Remote {
    pub(crate) const NONE: Remote = Remote(0);
    pub(crate) const BEACON: Remote = Remote(9);

    /// These buttons, in any order; `None` if no sensor could tell them.
    pub(crate) fn holding(buttons: &[Button]) -> Option<Remote> {
        let is_it = |held: &&[Button]| {
            held.len() == buttons.len() && held.iter().all(|button| buttons.contains(button))
        };
        let code = CODES.iter().position(is_it)?;
        u8::try_from(code).ok().map(Remote)
    }

    /// What `IR-REMOTE` shows.
    pub(crate) fn code(self) -> i32 {
        self.0.into()
    }

    /// What `IR-REM-A` shows.
    pub(crate) fn bits(self) -> i32 {
        let held = CODES[usize::from(self.0)];
        let bits = BITS.iter().filter(|(button, _)| held.contains(button));
        match bits.map(|(_, bit)| bit).sum() {
            0 => IDLE_BITS,
            bits => BASE_BITS + bits,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buttons_have_the_codes_of_the_sheet() {
        let code = |buttons: &[Button]| Remote::holding(buttons).map(Remote::code);
        assert_eq!(code(&[]), Some(0));
        assert_eq!(code(&[Button::BlueDown, Button::RedUp]), Some(6));
        assert_eq!(code(&[Button::Beacon]), Some(9));
        assert_eq!(code(&[Button::BlueUp, Button::BlueDown]), Some(11));
        assert_eq!(code(&[Button::RedUp, Button::RedUp]), None);
        assert_eq!(code(&[Button::RedUp, Button::BlueUp, Button::BlueDown]), None);
        assert_eq!(code(&[Button::RedUp, Button::Beacon]), None);
        assert_eq!(Remote::holding(&[Button::BlueUp]).unwrap().bits(), 256 + 64);
        assert_eq!(Remote::NONE.bits(), 384);
    }
}
