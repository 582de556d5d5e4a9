:- use_module('../support/child').
:- use_module('../support/dev').
:- use_module('../support/trees').

%   The commands of Goal to the tone generator.
told(Tree, Goal, Tones) :-
    on_dev(Tree, ( call(Goal), heard(Tree, Tones) )).

%   As plain/1, and Goal may throw Error.
told_by_thrower(Tree, Goal, Error, Tones) :-
    on_dev(Tree,
           ( catch(Goal, Error0, true),
             Error = Error0,
             heard(Tree, Tones) )).

:- begin_tests(tone).
test(sounds_and_ends, [forall(tree(Tree)), true(Tones == [440, 0])]) :-
    told(Tree, tone(440, 20), Tones).
test(takes_expressions, [forall(tree(Tree)), true(Tones == [880, 0])]) :-
    told(Tree, tone(2 * 440.2, 10 + 10), Tones).
test(lasts_as_long_as_it_is_told, true(abs(Time - 1.5) < 0.01)) :-
    with_sim(room, ( tone(440, 1500), sim_time(Time) )).
test(ends_where_it_is_interrupted,
     [forall(tree(Tree)), true(Error-Tones == enough-[440, 0])]) :-
    thread_self(Me),
    told_by_thrower(Tree,
                    ( later(0.05, thread_signal(Me, throw(enough))),
                      tone(440, 100000000) ),
                    Error, Tones).
test(fails_without_a_speaker, fail) :-
    with_dev([], tone(440, 10)).
test(knows_jessies_speaker, true(Bytes \== [])) :-
    Name = 'input/by-path/platform-snd-legoev3-event',
    with_dev([Name-[]],
             ( tone(440, 10), dev_path(Name, File), bytes_of(File, Bytes) )).
test(is_too_low, [forall(tree(Tree)), true(Error-Tones == domain_error(frequency, 99)-[])]) :-
    told_by_thrower(Tree, tone(99, 10), error(Error, _), Tones).
test(is_too_high, error(domain_error(frequency, 10001), _)) :-
    tone(10001, 10).
test(has_a_negative_time, error(domain_error(milliseconds, -1), _)) :-
    tone(440, -1).
test(has_no_frequency, error(instantiation_error, _)) :-
    tone(_, 10).
test(has_a_frequency_that_is_no_number, error(type_error(evaluable, high/0), _)) :-
    tone(high, 10).
:- end_tests(tone).

:- begin_tests(tones).
test(are_played_in_order, [forall(tree(Tree)), true(Tones == [262, 0, 440, 0])]) :-
    told(Tree, tones([tone(262, 10), rest(sixteenth), tone(440, 10)]), Tones).
test(are_notes, true(Tones == Expected)) :-
    findall(note(Pitch, sixteenth),
            member(Pitch, [c4, a4, fs4, 'f#4', bb3, gs2, ds9, b3]), Song),
    told(simulator, tones(Song), Heard),
    exclude(==(0), Heard, Tones),
    Expected = [262, 440, 370, 370, 233, 104, 9956, 247].
test(are_heard_apart, true(Tones == [262, 0, 262, 0])) :-
    told(simulator, tones([note(c4, quarter), note(c4, quarter)]), Tones).
test(take_their_time, [forall(member(Length-Expected,
                                     [ whole-2, half-1, quarter-0.5, eighth-0.25,
                                       sixteenth-0.125, dotted(half)-1.5,
                                       triplet(quarter)-0.3333
                                     ])),
                       true(abs(Time - Expected) < 0.01)]) :-
    with_sim(room, ( tones([note(c4, Length)]), sim_time(Time) )).
test(have_a_tempo, true(abs(Time - 1) < 0.01)) :-
    with_sim(room, ( tones([rest(quarter)], [tempo(60)]), sim_time(Time) )).
test(of_an_empty_list_are_none, true(Tones == [])) :-
    told(simulator, tones([]), Tones).
test(are_checked_before_one_is_heard,
     [ forall(member(Bad-Error,
                     [ note(h4, quarter)-domain_error(note, h4),
                       note(c10, quarter)-domain_error(note, c10),
                       note(c1, quarter)-domain_error(note, c1),
                       note(c4, long)-domain_error(note_length, long),
                       rest(dotted(_))-domain_error(note_length, dotted(_)),
                       note(_, quarter)-instantiation_error,
                       note(4, quarter)-type_error(atom, 4),
                       silence-domain_error(tone, silence),
                       _-instantiation_error
                     ])),
       true(Formal-Tones =@= Error-[])
     ]) :-
    told_by_thrower(simulator, tones([tone(440, 10), Bad]), error(Formal, _),
                    Tones).
test(are_no_list, error(type_error(list, c4), _)) :-
    tones(c4).
test(have_no_such_tempo, error(domain_error(tempo, 0), _)) :-
    tones([], [tempo(0)]).
test(have_no_such_option, error(domain_error(sound_option, speed(60)), _)) :-
    tones([], [speed(60)]).
test(fail_without_a_speaker, fail) :-
    with_dev([], tones([note(c4, quarter)])).
test(end_with_sound_stop, [forall(tree(Tree)), true(Tones == [440, 0])]) :-
    told(Tree,
         ( later(0.05, sound_stop),
           tones([tone(440, 1000000000), tone(880, 1000000000)])
         ), Tones).
:- end_tests(tones).

:- begin_tests(programs).
:- dynamic tool_directory/1.

%   Call Goal once with programs in the path that are shell scripts of these
%   Texts, and no others but the shell's.
with_programs(Programs, Goal) :-
    tmp_file(programs, Directory),
    getenv('PATH', Path),
    atomic_list_concat([Directory, ':/usr/bin:/bin'], With),
    setup_call_cleanup(
        ( make_directory(Directory),
          forall(member(Name-Text, Programs), script(Directory, Name, Text)),
          setenv('PATH', With)
        ),
        with_dev([], setup_call_cleanup(assertz(tool_directory(Directory)),
                                        once(Goal),
                                        retractall(tool_directory(_)))),
        ( setenv('PATH', Path),
          delete_directory_and_contents(Directory)
        )).

script(Directory, Name, Text) :-
    atomic_list_concat([Directory, /, Name], File),
    setup_call_cleanup(
        open(File, write, Stream),
        format(Stream, "#!/bin/sh~ncd ~w~n~w~n", [Directory, Text]),
        close(Stream)),
    process_create(path(chmod), ['+x', file(File)], []).

%   What a program left in a file beside it.
left(Name, Text) :-
    tool_directory(Directory),
    atomic_list_concat([Directory, /, Name], File),
    read_file_to_string(File, String, []),
    split_string(String, "", "\n", [Text]).

without_programs(Goal) :-
    getenv('PATH', Path),
    with_dev([],
             setup_call_cleanup(
                 setenv('PATH', '/no/such/directory'),
                 once(Goal),
                 setenv('PATH', Path))).

%   The text of an error.
message(Error, Text) :-
    message_to_codes(Error, Text).

message_to_codes(Term, Text) :-
    phrase('$messages':translate_message(Term), Lines),
    with_output_to(string(Text),
                   print_message_lines(current_output, '', Lines)).

with_wav(Milliseconds, File, Goal) :-
    tmp_file(wav, File),
    Count is 8 * Milliseconds,
    length(Samples, Count),
    maplist(=(128), Samples),
    % 8000 bytes a second: one channel of 8 bits
    atom_codes('RIFF----WAVEfmt ', Riff),
    append([ Riff, [16, 0, 0, 0, 1, 0, 1, 0, 0x40, 0x1f, 0, 0, 0x40, 0x1f, 0, 0,
                    1, 0, 8, 0],
             `data----`, Samples ], Bytes),
    setup_call_cleanup(put_bytes_of(write, File, Bytes),
                       once(Goal),
                       delete_file(File)).

test(say_gives_the_text_to_espeak_and_its_sound_to_aplay,
     true(Text-Sound == "--stdout -- -hello world"-"wave")) :-
    with_programs([ espeak-'echo "$@" > said; echo wave', aplay-'cat > heard' ],
                  ( say('-hello world'), left(said, Text), left(heard, Sound) )).
test(say_takes_strings, true(Text == "--stdout -- hello")) :-
    with_programs([ espeak-'echo "$@" > said', aplay-'cat > heard' ],
                  ( say("hello"), left(said, Text) )).
test(play_gives_the_file_to_aplay, true(Text == Expected)) :-
    with_wav(10, File,
             with_programs([ aplay-'echo "$@" > heard' ],
                           ( play(File), left(heard, Text) ))),
    format(string(Expected), "-q -- ~w", [File]).
test(the_first_program_of_a_pipe_that_failed_tells_why,
     [ forall(member(Espeak-Aplay,
                     [ 'echo why >&2; exit 1'-'cat; echo what >&2; exit 1',
                       'exec yes'-'echo why >&2; exit 1'
                     ])),
       true(Message == why) ]) :-
    with_programs([ espeak-Espeak, aplay-Aplay ],
                  catch(say(hello), error(_, context(_, Text)), true)),
    atomic_list_concat([_, Message], ': ', Text).
test(a_missing_program_is_named_with_its_package,
     [ forall(member(Goal-(Program-Package),
                     [ say(hello)-(espeak-'apt-get install espeak'),
                       volume(_)-(amixer-'apt-get install alsa-utils'),
                       volume(50)-(amixer-'apt-get install alsa-utils')
                     ])),
       true(Formal == existence_error(program, Program))
     ]) :-
    catch(without_programs(Goal), Error, true),
    Error = error(Formal, _),
    message(Error, Text),
    sub_string(Text, _, _, _, Package),
    !.
test(aplay_is_needed_to_play, error(existence_error(program, aplay), _)) :-
    with_wav(10, File, without_programs(play(File))).
test(aplay_is_needed_to_say, error(existence_error(program, aplay), _)) :-
    tmp_file(programs, Directory),
    getenv('PATH', Path),
    setup_call_cleanup(
        ( make_directory(Directory),
          script(Directory, espeak, 'echo wave'),
          setenv('PATH', Directory)
        ),
        with_dev([], say(hello)),
        ( setenv('PATH', Path),
          delete_directory_and_contents(Directory)
        )).
test(what_a_program_complains_of_is_told,
     error(system_error('aplay: audio open error: no card'), _)) :-
    with_programs([ espeak-'echo wave', aplay-'cat >/dev/null; echo audio open error: no card >&2; exit 1' ],
                  say(hello)).
test(a_program_ends_with_the_call_that_is_interrupted,
     true(Error-Alive == enough-false)) :-
    thread_self(Me),
    played_until(thread_signal(Me, throw(enough)), Error, Alive).
test(a_program_ends_with_sound_stop, true(Error-Alive == none-false)) :-
    played_until(sound_stop, Error, Alive).
test(play_refuses_what_is_no_wav, [forall(tree(Tree)), error(syntax_error(wav), _)]) :-
    on_dev(Tree, play('tests/prolog/test_sound.pl')).
test(play_refuses_a_missing_file, error(existence_error(file, _), _)) :-
    on_dev(simulator, play('no such.wav')).
test(say_needs_a_text, error(instantiation_error, _)) :-
    on_dev(simulator, say(_)).
test(play_needs_a_file, error(instantiation_error, _)) :-
    play(_).

%   Play a file; as soon as the program for that is there, another thread calls
%   Goal.
played_until(Goal, Error, Alive) :-
    with_wav(10, File,
             with_programs([ aplay-'echo $$ > pid.new; mv pid.new pid; exec sleep 1000' ],
                           ( thread_create(( started, Goal ), Id, []),
                             catch(( play(File), Error = none ), Error, true),
                             thread_join(Id, true),
                             left(pid, Pid),
                             alive(Pid, Alive) ))).

started :-
    eventually(catch(left(pid, _), _, fail)).

alive(Pid, Alive) :-
    atom_concat('/proc/', Pid, Directory),
    (   exists_directory(Directory)
    ->  Alive = true
    ;   Alive = false
    ).
:- end_tests(programs).

:- begin_tests(volume, [setup(true)]).
amixer("Simple mixer control 'Beep',0
  Capabilities: volume
  Mono: 51 [20%]
Simple mixer control 'PCM',0
  Capabilities: pvolume
  Mono: Playback 192 [75%]").

with_mixer(Goal) :-
    amixer(Text),
    format(atom(Script),
           "if [ $1 = scontents ]; then cat <<'END'~n~w~nEND~nelse echo \"$@\" >> set; fi",
           [Text]),
    plunit_programs:with_programs([amixer-Script], Goal).

test(is_that_of_recordings, true(Percent == 75)) :-
    with_mixer(volume(Percent)).
test(is_set_for_all_there_is, true(Set == "-q sset PCM 30%\n-q sset Beep 30%")) :-
    with_mixer(( volume(30), plunit_programs:left(set, Set) )).
test(fails_without_a_card, fail) :-
    plunit_programs:with_programs([amixer-'echo no card >&2; exit 1'], volume(_)).
test(fails_without_a_card_to_set, fail) :-
    plunit_programs:with_programs([amixer-'echo no card >&2; exit 1'], volume(10)).
test(is_kept_by_the_simulator, true(A-B == 100-40)) :-
    with_sim(room, ( volume(A), volume(20 + 20), volume(B) )).
test(is_at_most_100, error(domain_error(volume, 101), _)) :-
    with_sim(room, volume(101)).
test(is_not_negative, error(domain_error(volume, -1), _)) :-
    with_sim(room, volume(-1)).
test(is_a_number, error(type_error(evaluable, loud/0), _)) :-
    volume(loud).
:- end_tests(volume).

:- begin_tests(sound_stop).
test(does_nothing_in_silence) :-
    on_dev(plain, sound_stop).
test(ends_speech_of_the_simulator, true(Events == [said(Text), silenced])) :-
    Text = 'and so on, and so on, and so on, and so on, and so on, and so on',
    with_sim(room,
             ( thread_create(say(Text), Id, []),
               eventually(( sim_trace(T0), memberchk(_-said(_), T0) )),
               sound_stop,
               thread_join(Id, true),
               sim_trace(Trace),
               findall(Event, ( member(_-Event, Trace), heard_event(Event) ), Events) ),
             [clock(realtime)]).
test(nothing_sounds_after_halt, true(Status-Tones == exit(0)-[440, 0])) :-
    on_dev(plain,
           ( ev3_dev(Dev),
             format(string(Text),
                    ":- use_module(library(ev3dev)).
                     main :- ev3_dev('~w'),
                             thread_create(tone(440, 100000000), _, []),
                             heard, halt.
                     heard :- repeat,
                              size_file('~w/input/by-path/platform-sound-event', N),
                              N > 0, !.", [Dev, Dev]),
             run_program(Text, [goal(main)], Status, _),
             heard(plain, Tones) )).

heard_event(said(_)).
heard_event(silenced).
:- end_tests(sound_stop).

:- begin_tests(simulated_sound).
test(speech_and_recordings_are_traced_and_take_time,
     true(Events-Longer == [said(hello), played(File)]-true)) :-
    plunit_programs:with_wav(2000, File,
        with_sim(room,
                 ( say(hello), sim_time(T1), play(File), sim_time(T2),
                   sim_trace(Trace) ))),
    findall(Event,
            ( member(_-Event, Trace),
              ( Event = said(_) ; Event = played(_) ) ),
            Events),
    (   T1 > 0.2, abs(T2 - T1 - 2) < 0.01
    ->  Longer = true
    ;   Longer = false
    ).
:- end_tests(simulated_sound).

:- begin_tests(without_waiting).
test(tones_play_while_the_program_goes_on, true(Heard-T0 == [0-440, 1-880, 2-0]-0)) :-
    with_sim(room, ( tones([tone(440, 1000), tone(880, 1000)], [wait(false)]),
                     sim_time(T1), T0 is round(T1),
                     wait(3), heard_at(Heard) )).
test(its_end_can_be_waited_for,
     [ forall(member(Goal, [tone(440, 2000, [wait(false)]), tones([tone(440, 2000)], [wait(false)])])) ]) :-
    with_sim(room, ( Goal, sound_wait, sim_time(T), sound_wait, sim_time(T1) )),
    near(T, 2, 0.05),
    near(T1, 2, 0.06).
test(it_can_be_stopped, true(Heard == [0-440, 1-0])) :-
    with_sim(room, ( tone(440, 5000, [wait(false)]), wait(1), sound_stop,
                     sound_wait, wait(7), heard_at(Heard) )).
test(the_next_takes_its_place, true(Heard == [0-440, 1-0, 1-880, 3-0])) :-
    with_sim(room, ( tone(440, 5000, [wait(false)]), wait(1),
                     tone(880, 2000, [wait(false)]), sound_wait, wait(3), heard_at(Heard) )).
test(speech_does_not_wait_either) :-
    with_sim(room, ( say(hello, [wait(false)]), sim_time(T0), sound_wait, sim_time(T) )),
    near(T0, 0, 0.05),
    T > 0.2.
test(speech_can_be_stopped, true(Events == [said(hello), silenced])) :-
    with_sim(room, ( say(hello, [wait(false)]), wait(0.1), sound_stop, sound_wait,
                     sim_time(T), T < 0.2,
                     sim_trace(Trace),
                     findall(E, ( member(_-E, Trace), memberchk(E, [said(_), silenced]) ), Events) )).
test(a_move_goes_on_meanwhile) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   tone(440, 1000, [wait(false)]), go_cm(30, 40), sim_time(T), sim_pose(_, Y, _) )),
    near(Y, 40, 0.5),
    T > 1.
test(options_are_checked,
     [ forall(( member(Option-Error, [ wait(1)-type_error(bool, 1), wayt(true)-domain_error(sound_option, _) ]),
                member(Goal, [ tone(440, 10, [Option]), tones([], [Option]), say(a, [Option]),
                               play('x.wav', [Option]) ]) )),
       error(Error, _) ]) :-
    with_sim(room, Goal).

%   When, in whole seconds, the tone generator changed to which tone.
heard_at(Heard) :-
    sim_trace(Trace),
    findall(S-Hertz, ( member(T-tone(Hertz), Trace), S is round(T) ), Heard).
:- end_tests(without_waiting).
