:- module(ev3dev_far_frames,
          [ protocol/1,                 % -Version
            send_frame/4,               % +Stream, +Kind, +Number, +Term
            receive_frames/2,           % +Stream, :Closure
            beat/1                      % +Stream
          ]).
:- use_module('../errors/errors', [throw_error/3]).

:- meta_predicate receive_frames(+, 3).

/** <module> The protocol between a far brick and its program

A frame is a line: the character of code 1, a kind, a number, and a term that
ignores operators. What stands before that character, and lines without it,
are the output of the brick's program, in their order among the frames.

| kind     | from    | number | term                                        |
|----------|---------|--------|---------------------------------------------|
| `hello`  | both    | 0      | version of these frames; the first one      |
| `alive`  | both    | 0      | four times a second                         |
| `call`   | program | call's | goal(Variables, Goal)                       |
| `load`   | program | call's | file(Name, Text)                            |
| `answer` | brick   | call's | `yes(Variables)`, `no` or `error(Error)`    |
| `cancel` | program | call's | the answer is wanted no more                |
| `idle`   | program | call's | stop what turns, unless a goal runs         |
| `stop`   | program | 0      | stop all motors                             |
| `end`    | program | 0      | stop all motors, and end                    |
*/

%!  protocol(-Version) is det.
%
%   The version of the frames of this pack.

protocol(1).

%   Characters; a program of a brick has some thousands.
longest(1000000).

%!  send_frame(+Stream, +Kind, +Number, +Term) is det.
%
%   Send a frame.
%
%   @error type_error(acyclic_term, Term)
%   @error resource_error(frame) if it is longer than a million characters

send_frame(Stream, Kind, Number, Term) :-
    (   acyclic_term(Term)
    ->  true
    ;   throw_error(type_error(acyclic_term, Term), _,
                    'a term that contains itself cannot be sent')
    ),
    format(string(Text), '~k', [Term]),
    string_length(Text, Length),
    longest(Most),
    (   Length =< Most
    ->  true
    ;   throw_error(resource_error(frame), _,
                    'this is longer than the million characters that a far \c
                     brick takes at once')
    ),
    format(Stream, '\001\~w ~d ~s~n', [Kind, Number, Text]),
    flush_output(Stream).

%!  receive_frames(+Stream, :Closure) is det.
%
%   Until Stream ends, or is silent for longer than its timeout: call(Closure,
%   Kind, Number, Term) for each frame. Term is `unreadable` if it has
%   something in it that cannot be sent, as a stream. Kind is `output`, and
%   Term a string, for what is not a frame.

receive_frames(Stream, Closure) :-
    repeat,
    (   catch(read_line(Stream, Line), error(_, _), fail)
    ->  received(Line, Closure),
        fail
    ;   !
    ).

%   Fails at the end; read_string/5 may fail there itself (7.2.3, at halt).

read_line(Stream, Line) :-
    read_string(Stream, "\n", "", End, Line),
    \+ ( End == -1, Line == "" ).

received(Line, Closure) :-
    (   sub_string(Line, Before, 1, After, "\001\")
    ->  sub_string(Line, 0, Before, _, Output),
        sub_string(Line, _, After, 0, Frame),
        (   Output == ""
        ->  true
        ;   call(Closure, output, 0, Output)
        ),
        (   frame(Frame, Kind, Number, Term)
        ->  call(Closure, Kind, Number, Term)
        ;   true
        )
    ;   call(Closure, output, 0, Line)
    ).

frame(Frame, Kind, Number, Term) :-
    sub_string(Frame, Space, 1, _, " "),
    !,
    sub_atom(Frame, 0, Space, _, Kind),
    From is Space+1,
    sub_string(Frame, From, _, 0, Rest),
    sub_string(Rest, Next, 1, After, " "),
    !,
    sub_string(Rest, 0, Next, _, Digits),
    number_string(Number, Digits),
    sub_string(Rest, _, After, 0, Text),
    catch(term_string(Term, Text), error(_, _), Term = unreadable).

%!  beat(+Stream) is det.
%
%   Four times a second send `alive`, until this thread gets the message
%   `over`, or nobody reads it any more.

beat(Stream) :-
    thread_self(Me),
    repeat,
    (   thread_get_message(Me, over, [timeout(0.25)])
    ->  true
    ;   catch(send_frame(Stream, alive, 0, []), error(_, _), true)
    ->  fail
    ),
    !.
