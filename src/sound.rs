//! `prolog/ev3dev/sound.pl`: the loudspeaker.
use crate::glue::call::Call;
use crate::glue::state::{dev, devices, sound};
use crate::glue::terms::{Prolog, unify_atom};
use ev3_driver::brick::sound::{self, Tone};
use ev3_driver::journal::SoundCommand;
use ev3_driver::wait::AnyWait;
use std::path::Path;
use std::time::Duration;
use swipl::prelude::*;

natives! {
    /// tones_(+Tones, +Wait, -Reason): a list of tone(Hertz, Milliseconds); 0 Hz is
    /// silence. `over` at the end.
    nondet fn "tones_"<UntilSilent>(context, tones, wait, reason) as call("tones", 2) {
        setup => {
            let tones = call.list(tones)?;
            let tones = tones.iter().map(|tone| tone_of(&call, tone)).collect::<PrologResult<Vec<_>>>()?;
            let dev = call.dev()?;
            let noted = tones.iter().map(|tone| (tone.hertz, tone.lasts)).collect();
            let playing = if wait.get_ex()? {
                Some(call.or_fail(sound().play_tones(&dev, tones))?)
            } else {
                call.or_fail(sound().begin_tones(devices().tree(), &*dev, tones))?;
                None
            };
            call.note_sound(SoundCommand::Tones(noted));
            Ok(Some(playing))
        },
        call(sound) => {
            play_on(&call, sound, reason)
        }
    }

    /// say_(+Text, +Wait, -Reason)
    nondet fn "say_"<UntilSilent>(context, text, wait, reason) as call("say", 1) {
        setup => {
            let (text, dev) = (call.text(text)?, call.dev()?);
            let saying = if wait.get_ex()? {
                Some(call.or_throw(sound().say(&dev, &text))?)
            } else {
                call.or_throw(sound().begin_saying(devices().tree(), &*dev, &text))?;
                None
            };
            call.note_sound(SoundCommand::Say((&*text).into()));
            Ok(Some(saying))
        },
        call(sound) => {
            play_on(&call, sound, reason)
        }
    }

    /// play_(+File, +Wait, -Reason)
    nondet fn "play_"<UntilSilent>(context, file, wait, reason) as call("play", 1) {
        setup => {
            let (file, dev) = (call.text(file)?, call.dev()?);
            let playing = if wait.get_ex()? {
                Some(call.or_throw(sound().play(&dev, Path::new(&*file)))?)
            } else {
                let tree = devices();
                call.or_throw(sound().begin_playing(tree.tree(), &*dev, Path::new(&*file)))?;
                None
            };
            call.note_sound(SoundCommand::Play((&*file).into()));
            Ok(Some(playing))
        },
        call(sound) => {
            play_on(&call, sound, reason)
        }
    }

    /// volume_(-Percent)
    semidet fn "volume_"(context, percent) as call("volume", 1) {
        let volume = call.or_throw(sound::volume(&*call.dev()?))?;
        percent.unify(i64::from(volume.map_or_else(|| call.lacking("speaker"), Ok)?))
    }

    /// volume_set_(+Percent): from 0 to 100.
    semidet fn "volume_set_"(context, percent) as call("volume", 1) {
        let percent = u8::try_from(call.integer(percent)?).map_err(|_| PrologError::Failure)?;
        let set = call.or_throw(sound::set_volume(&*call.dev()?, percent))?;
        set.map_or_else(|| call.lacking("speaker"), Ok)
    }

    /// sound_wait_(-Reason): `over` at the end.
    nondet fn "sound_wait_"<UntilSilent>(context, reason) as call("sound_wait", 0) {
        setup => {
            let dev = call.dev()?;
            let waiting = sound().until_silent(&dev);
            Ok(Some(Some(waiting)))
        },
        call(sound) => {
            play_on(&call, sound, reason)
        }
    }

    /// sound_stop_
    semidet fn "sound_stop_"(context) as call("sound_stop", 0) {
        // This does not choose a tree: the call that started the sound has done so.
        call.note_sound(SoundCommand::Stop);
        call.or_throw(sound().stop(&*dev()))
    }
}

/// A sound that somebody waits for, or none.
type UntilSilent = Option<AnyWait<'static, ()>>;

/// A slice of that wait.
fn play_on<C: Prolog>(
    call: &Call<C>,
    sound: &mut UntilSilent,
    reason: &Term,
) -> PrologResult<bool> {
    match sound {
        Some(sound) => call.slice(sound, reason, |()| unify_atom(reason, "over")),
        None => unify_atom(reason, "over").map(|()| false),
    }
}

fn tone_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Tone> {
    let [hertz, milliseconds] = call.arguments(term)?;
    let hertz = u32::try_from(call.integer(&hertz)?).map_err(|_| PrologError::Failure)?;
    let lasts = call.seconds(&milliseconds)?.unwrap_or(Duration::MAX) / 1000;
    Ok(Tone { hertz, lasts })
}
