//! `prolog/ev3dev/sound.pl`: the loudspeaker.
use crate::glue::call::Call;
use crate::glue::state::{dev, sound};
use ev3_driver::brick::sound::{self, Tone};
use std::path::Path;
use std::time::Duration;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_tones();
    register_say();
    register_play();
    register_volume();
    register_volume_set();
    register_sound_stop();
}

predicates! {
    /// tones_(+Tones): a list of tone(Hertz, Milliseconds); 0 Hz is silence.
    #[module("ev3dev_native")]
    #[name("tones_")]
    semidet fn tones(context, tones) {
        let call = Call::of(context, "tones", 2);
        let tones = call.list(tones)?;
        let tones = tones.iter().map(|tone| tone_of(&call, tone)).collect::<PrologResult<Vec<_>>>()?;
        let dev = call.dev()?;
        call.or_fail(sound().play_tones(&*dev, &tones, &mut call.interrupted()))
    }

    /// say_(+Text)
    #[module("ev3dev_native")]
    #[name("say_")]
    semidet fn say(context, text) {
        let call = Call::of(context, "say", 1);
        let (text, dev) = (call.text(text)?, call.dev()?);
        call.or_throw(sound().say(&*dev, &text, &mut call.interrupted()))
    }

    /// play_(+File)
    #[module("ev3dev_native")]
    #[name("play_")]
    semidet fn play(context, file) {
        let call = Call::of(context, "play", 1);
        let (file, dev) = (call.text(file)?, call.dev()?);
        call.or_throw(sound().play(&*dev, Path::new(&*file), &mut call.interrupted()))
    }

    /// volume_(-Percent)
    #[module("ev3dev_native")]
    #[name("volume_")]
    semidet fn volume(context, percent) {
        let call = Call::of(context, "volume", 1);
        let volume = call.or_throw(sound::volume(&*call.dev()?))?;
        percent.unify(i64::from(volume.map_or_else(|| call.lacking("speaker"), Ok)?))
    }

    /// volume_set_(+Percent): from 0 to 100.
    #[module("ev3dev_native")]
    #[name("volume_set_")]
    semidet fn volume_set(context, percent) {
        let call = Call::of(context, "volume", 1);
        let percent = u8::try_from(call.integer(percent)?).map_err(|_| PrologError::Failure)?;
        let set = call.or_throw(sound::set_volume(&*call.dev()?, percent))?;
        set.map_or_else(|| call.lacking("speaker"), Ok)
    }

    /// sound_stop_
    #[module("ev3dev_native")]
    #[name("sound_stop_")]
    semidet fn sound_stop(context) {
        // This does not choose a tree: the call that started the sound has done so.
        Call::of(context, "sound_stop", 0).or_throw(sound().stop(&*dev()))
    }
}

fn tone_of<'a, C: QueryableContextType>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Tone> {
    let [hertz, milliseconds] = call.arguments(term)?;
    let hertz = u32::try_from(call.integer(&hertz)?).map_err(|_| PrologError::Failure)?;
    let lasts = call.seconds(&milliseconds)?.unwrap_or(Duration::MAX) / 1000;
    Ok(Tone { hertz, lasts })
}
