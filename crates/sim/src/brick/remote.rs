//! The remote control of the EV3 set: two red and two blue buttons, a button for the beacon, and
//! a switch for four channels.

/// How many channels there are.
pub(crate) const CHANNELS: usize = 4;

/// A button that is held down. The beacon's stays down until it is pressed again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RemoteButton {
    /// Upper left.
    RedUp,
    /// Lower left.
    RedDown,
    /// Upper right.
    BlueUp,
    /// Lower right.
    BlueDown,
    /// The gray one in the middle.
    Beacon,
}

/// The pressed buttons of a channel: one button, or two that the sensor can distinguish from
/// others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Remote(u8);

/// In the order of the codes of the mode `IR-REMOTE`.
const CODES: [&[RemoteButton]; 12] = [
    &[],
    &[RemoteButton::RedUp],
    &[RemoteButton::RedDown],
    &[RemoteButton::BlueUp],
    &[RemoteButton::BlueDown],
    &[RemoteButton::RedUp, RemoteButton::BlueUp],
    &[RemoteButton::RedUp, RemoteButton::BlueDown],
    &[RemoteButton::RedDown, RemoteButton::BlueUp],
    &[RemoteButton::RedDown, RemoteButton::BlueDown],
    &[RemoteButton::Beacon],
    &[RemoteButton::RedUp, RemoteButton::RedDown],
    &[RemoteButton::BlueUp, RemoteButton::BlueDown],
];
/// The value of `IR-REM-A` with no button pressed, its constant bits, and the bit of each button.
const IDLE_BITS: i32 = 384;
const BASE_BITS: i32 = 256;
const BITS: [(RemoteButton, i32); 4] = [
    (RemoteButton::RedUp, 1 << 4),
    (RemoteButton::RedDown, 1 << 5),
    (RemoteButton::BlueUp, 1 << 6),
    (RemoteButton::BlueDown, 1 << 7),
];

impl Remote {
    pub(crate) const NONE: Remote = Remote(0);
    pub(crate) const BEACON: Remote = Remote(9);

    /// These buttons, in any order; `None` if no sensor can report this combination.
    pub(crate) fn holding(buttons: &[RemoteButton]) -> Option<Remote> {
        let is_it = |held: &&[RemoteButton]| {
            held.len() == buttons.len() && held.iter().all(|button| buttons.contains(button))
        };
        let code = CODES.iter().position(is_it)?;
        u8::try_from(code).ok().map(Remote)
    }

    /// The value of `IR-REMOTE`.
    pub(crate) fn code(self) -> i32 {
        self.0.into()
    }

    /// The value of `IR-REM-A`.
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
        let code = |buttons: &[RemoteButton]| Remote::holding(buttons).map(Remote::code);
        assert_eq!(code(&[]), Some(0));
        assert_eq!(code(&[RemoteButton::BlueDown, RemoteButton::RedUp]), Some(6));
        assert_eq!(code(&[RemoteButton::Beacon]), Some(9));
        assert_eq!(code(&[RemoteButton::BlueUp, RemoteButton::BlueDown]), Some(11));
        assert_eq!(code(&[RemoteButton::RedUp, RemoteButton::RedUp]), None);
        assert_eq!(
            code(&[RemoteButton::RedUp, RemoteButton::BlueUp, RemoteButton::BlueDown]),
            None
        );
        assert_eq!(code(&[RemoteButton::RedUp, RemoteButton::Beacon]), None);
        assert_eq!(Remote::holding(&[RemoteButton::BlueUp]).unwrap().bits(), 256 + 64);
        assert_eq!(Remote::NONE.bits(), 384);
    }
}
