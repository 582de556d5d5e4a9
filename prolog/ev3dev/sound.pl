:- module(ev3dev_sound,
          [ tone/2,                     % +Hertz, +Milliseconds
            tone/3,                     % +Hertz, +Milliseconds, +Options
            tones/1,                    % +Tones
            tones/2,                    % +Tones, +Options
            say/1,                      % +Text
            say/2,                      % +Text, +Options
            play/1,                     % +File
            play/2,                     % +File, +Options
            volume/1,                   % ?Percent
            sound_wait/0,
            sound_stop/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2, must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(files, []).
:- use_module(private/checks/arguments,
              [must_be_options/3, option/3, word/2]).
:- use_module(private/files/directory, [file_path/2]).
:- use_module(private/run/waits, [waited/1]).
:- use_module(private/native/native,
              [ play_/3, say_/3, sound_stop_/0, sound_wait_/1, tones_/3,
                volume_/1, volume_set_/1 ]).

/** <module> The speaker

tone/2, tones/1, say/1 and play/1 wait until the sound is over. If an
exception, for example Ctrl-C, ends a call, its sound stops first. When Prolog
halts, all sounds of the program stop.

With the option `wait(false)` of tone/3, tones/2, say/2 and play/2 a sound
plays while the program goes on. It takes the place of all other sounds. Then
sound_wait/0 waits until it is over, and sound_stop/0 ends it.

Tones fail if there is no speaker. Speech needs the program `espeak`, and
speech and recordings need `aplay` of the package `alsa-utils`; the user may
have to install both.

```
?- tones([note(c4, quarter), note(e4, quarter), note(g4, half)]).
?- say('I am a robot').
```
*/

%!  tone(+Hertz, +Milliseconds) is semidet.
%!  tone(+Hertz, +Milliseconds, +Options) is semidet.
%
%   Play a tone from 100 to 10000 Hz, and wait until it is over. Both
%   arguments may be arithmetic expressions. While a recording plays, the
%   speaker plays no tone. Options:
%
%     - wait(+Boolean)
%       If `false`, return as soon as the tone plays. Default is `true`.
%
%   @error domain_error(frequency, Hertz)
%   @error domain_error(milliseconds, Milliseconds) if Milliseconds is
%          negative

tone(Hertz, Milliseconds) :-
    tone(Hertz, Milliseconds, []).

tone(Hertz, Milliseconds, Options) :-
    wait_option([], Options, Wait),
    native_tones([tone(Hertz, Milliseconds)], 500, Native),
    Native = [tone(_, Time)],
    (   Time > 0,
        Time < 10
    ->  advise(not_milliseconds(tone/2, Time))
    ;   true
    ),
    tones_or_explain(Native, Wait).

%   Wait is the value of the option `wait`, which has company in Names.
wait_option(Names, Options, Wait) :-
    must_be_options(sound_option, [wait|Names], Options),
    option(wait(Wait), Options, true),
    must_be(boolean, Wait).

tones_or_explain(Native, Wait) :-
    (   tones_(Native, Wait, Reason),
        waited(Reason)
    ->  true
    ;   fail_because(lacking(speaker))
    ).

%!  tones(+Tones) is semidet.
%!  tones(+Tones, +Options) is semidet.
%
%   Play a list of tones one after the other, and wait until they are over.
%   The call checks all tones before it plays the first. Each is one of
%
%     - tone(Hertz, Milliseconds)
%     - note(Pitch, Length)
%       Pitch is a letter from `a` to `g`, then optionally `s` for sharp or
%       `b` for flat, then the octave: `c4` is the middle C, `a4` has 440 Hz,
%       `fs4` is above `f4`, `bb3` below `b3`. The lowest is `gs2`, the
%       highest `ds9`. A note sounds for nine tenths of its time, so that a
%       short silence separates it from the next.
%     - rest(Length)
%       Silence.
%
%   A Length is `whole`, `half`, `quarter`, `eighth` or `sixteenth`,
%   `dotted(Length)`, half as long again, or `triplet(Length)`, two thirds.
%   Options:
%
%     - tempo(+QuartersPerMinute)
%       Default is 120.
%     - wait(+Boolean)
%       If `false`, return as soon as the first tone plays. Default is `true`.
%
%   @error domain_error(tone, Tone)
%   @error domain_error(note, Pitch)
%   @error domain_error(note_length, Length)
%   @error domain_error(tempo, QuartersPerMinute)
%   @error domain_error(sound_option, Option) if Option is not an option of
%          this predicate

tones(Tones) :-
    tones(Tones, []).

tones(Tones, Options) :-
    must_be(list, Tones),
    wait_option([tempo], Options, Wait),
    option(tempo(Tempo), Options, 120),
    must_be(number, Tempo),
    (   Tempo > 0
    ->  Quarter is 60000 / Tempo
    ;   domain_error(tempo, Tempo)
    ),
    native_tones(Tones, Quarter, Native),
    tones_or_explain(Native, Wait).

%   Native are terms tone(Hertz, Milliseconds), 0 Hz for silence.

native_tones([], _, []).
native_tones([Tone|Tones], Quarter, Native) :-
    must_be(nonvar, Tone),
    (   native(Tone, Quarter, Native, Rest)
    ->  true
    ;   domain_error(tone, Tone)
    ),
    native_tones(Tones, Quarter, Rest).

native(tone(Hertz0, Time0), _, [tone(Hertz, Time)|Rest], Rest) :-
    evaluated(round(Hertz0), Hertz),
    evaluated(Time0, Time),
    (   integer(Hertz),
        between(100, 10000, Hertz)
    ->  true
    ;   domain_error(frequency, Hertz0)
    ),
    (   Time >= 0
    ->  true
    ;   domain_error(milliseconds, Time0)
    ).
native(note(Pitch, Length), Quarter, [tone(Hertz, Held), tone(0, Gap)|Rest],
       Rest) :-
    (   pitch(Pitch, Hertz)
    ->  true
    ;   domain_error(note, Pitch)
    ),
    time(Length, Quarter, Time),
    Held is 0.9 * Time,
    Gap is 0.1 * Time.
native(rest(Length), Quarter, [tone(0, Time)|Rest], Rest) :-
    time(Length, Quarter, Time).

%   A tempered scale of twelve steps an octave, in which a4 is number 57.

pitch(Pitch0, Hertz) :-
    word(Pitch0, Pitch),
    atom_codes(Pitch, [Letter|Codes]),
    step([Letter], Step),
    (   Codes = [Digit],
        Shift = 0
    ;   Codes = [Sign, Digit],
        shift([Sign], Shift)
    ),
    code_type(Digit, digit(Octave)),
    !,
    Hertz is round(440 * 2 ** ((12 * Octave + Step + Shift - 57) / 12.0)),
    between(100, 10000, Hertz).

step(`c`, 0).
step(`d`, 2).
step(`e`, 4).
step(`f`, 5).
step(`g`, 7).
step(`a`, 9).
step(`b`, 11).

shift(`s`, 1).
shift(`#`, 1).
shift(`b`, -1).

time(Length, Quarter, Time) :-
    must_be(nonvar, Length),
    (   quarters(Length, Quarters)
    ->  Time is Quarters * Quarter
    ;   domain_error(note_length, Length)
    ).

quarters(whole, 4).
quarters(half, 2).
quarters(quarter, 1).
quarters(eighth, 0.5).
quarters(sixteenth, 0.25).
quarters(dotted(Length), Quarters) :-
    nonvar(Length),
    quarters(Length, Quarters0),
    Quarters is 1.5 * Quarters0.
quarters(triplet(Length), Quarters) :-
    nonvar(Length),
    quarters(Length, Quarters0),
    Quarters is 2 * Quarters0 / 3.

%!  say(+Text) is semidet.
%!  say(+Text, +Options) is semidet.
%
%   Say a text and wait until it is said. Text is an atom or a string. The
%   option `wait` is that of tone/3.
%
%   @error existence_error(program, Program) if Program, `espeak` or `aplay`,
%          is missing: the message names the package to install
%   @error system_error(Words) if one of these programs reports an error

say(Text) :-
    say(Text, []).

say(Text, Options) :-
    must_be(text, Text),
    wait_option([], Options, Wait),
    (   spoken(Text, Wait)
    ->  true
    ;   say_(Text, Wait, Reason),
        waited(Reason)
    ),
    !.

%   A page that Prolog runs in speaks itself: it adds the clause.
:- multifile spoken/2.                  % +Text, +Wait

%!  play(+File) is semidet.
%!  play(+File, +Options) is semidet.
%
%   Play a WAV file, and wait until it is over. The option `wait` is that of
%   tone/3.
%
%   @error existence_error(file, File)
%   @error syntax_error(wav) if File is no WAV file
%   @error existence_error(program, aplay) if `aplay` is missing: the message
%          names the package to install
%   @error system_error(Words) if `aplay` reports an error

play(File) :-
    play(File, []).

play(File, Options) :-
    must_be(nonvar, File),
    wait_option([], Options, Wait),
    file_path(File, Path),
    play_(Path, Wait, Reason),
    waited(Reason),
    !.

%!  volume(?Percent) is semidet.
%
%   Read the volume, or set it to a percentage from 0 to 100, which may be an
%   arithmetic expression. ev3dev-stretch has two volumes: reading returns
%   that of recordings, and setting changes that of recordings and that of
%   tones. Fails if the machine has no volume control.
%
%   @error domain_error(volume, Percent)
%   @error existence_error(program, amixer) if `amixer` is missing: the
%          message names the package to install

volume(Percent) :-
    var(Percent),
    !,
    volume_(Percent).
volume(Percent0) :-
    evaluated(round(Percent0), Percent),
    (   integer(Percent),
        between(0, 100, Percent)
    ->  volume_set_(Percent)
    ;   domain_error(volume, Percent0)
    ).

%!  sound_wait is det.
%
%   Wait until the sounds that were started with `wait(false)` are over. Does
%   not wait if there is none.
%
%   @error system_error(Words) if `espeak` or `aplay` reported an error

sound_wait :-
    sound_wait_(Reason),
    waited(Reason),
    !.

%!  sound_stop is det.
%
%   Stop all sounds of this program. Calls in other threads that wait for a
%   sound succeed.

sound_stop :-
    sound_stop_.

:- initialization(at_halt(sound_stop_), now).
