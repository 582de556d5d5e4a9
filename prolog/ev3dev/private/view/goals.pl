:- module(ev3dev_view_goals,
          [ goal_line/4,                % +Word, +Rest, +Page, -Refused
            goals_end/1,                % +Page
            goal_solve/5                % +Text, +Page, +Number, +In, :Next
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(library(prolog_stream), [open_prolog_stream/4]).
:- use_module('../explain/hints', [tell_again/0]).
:- use_module('../native/native', [view_part_/0, view_say_/2]).
:- use_module(log, [error_text/2, note/2]).
:- use_module(program, [part_begins/1, part_ends/1, program_state/1]).

/** <module> Goals that are typed into a page

Only with the option `goals(true)`, and only at localhost. A goal runs in a
thread of its own, as a part of the program. The log shows it, with its output
and its answers. What it reads is typed into the page.
*/

:- meta_predicate goal_solve(+, +, +, +, 1).

:- dynamic
    running/3,                          % Page, Number, Thread
    earlier/2.                          % Name, Value: of an answer

%   failed(Goal): what else is to be said of a goal that is false.
:- multifile failed/1.

%!  goal_line(+Word, +Rest, +Page, -Refused) is semidet.
%
%   Start a goal, ask for its next answer, end it, or give it a line that it
%   reads. A new goal ends one that waits to be asked. Fails if that is not a
%   line; Refused is bound to a text if it is not the time for it.

goal_line(goal, Rest, Page, Refused) :-
    sub_string(Rest, Before, 1, After, " "),
    !,
    sub_string(Rest, 0, Before, _, Number0),
    sub_string(Rest, _, After, 0, Text),
    number_of(Number0, Number),
    with_mutex(ev3dev_view_goals, begin(Text, Number, Page, Refused)).
goal_line(Word, Rest, Page, _) :-
    (   Word == input
    ->  Message = input(Rest)
    ;   memberchk(Word, [more, enough]),
        Message = Word,
        number_of(Rest, Number)
    ),
    (   running(Page, Number, Thread)
    ->  send(Thread, Message)
    ;   true
    ).

begin(Text, Number, Page, Refused) :-
    (   program_state(State),
        State \== idle
    ->  Refused = "A program runs. STOP ends it."
    ;   (   retract(running(Page, _, Former))
        ->  send(Former, enough)
        ;   Former = none
        ),
        thread_create(ev3dev_view_goals:solve(Text, Number, Page, Former),
                      Thread, []),
        assertz(running(Page, Number, Thread)),
        part_begins(Thread),
        send(Thread, begin)
    ).

send(Thread, Word) :-
    catch(thread_send_message(Thread, ev3dev_view_goal(Word)), _, true).

number_of(Text, Number) :-
    string_length(Text, Length),
    between(1, 9, Length),
    string_codes(Text, Codes),
    \+ ( member(Code, Codes),
         \+ between(0'0, 0'9, Code) ),
    number_codes(Number, Codes).

%!  goals_end(+Page) is det.
%
%   End the goal of this page. Waits for that.

goals_end(Page) :-
    forall(retract(running(Page, _, Thread)),
           ( catch(thread_signal(Thread, abort), _, true),
             ended(Thread) )).

%   Prolog warns of a thread that is aborted, unless another one joins it.
ended(Thread) :-
    (   Thread == none
    ->  true
    ;   catch(thread_join(Thread, _), _, true)
    ).

%   An abort is thrown again after what is done here.
solve(Text, Number, Page, Former) :-
    thread_get_message(ev3dev_view_goal(begin)),
    view_part_,
    ended(Former),
    open_prolog_stream(ev3dev_view_goals, read, In, []),
    goal_solve(Text, Page, Number, In, told).

%   Called for each line of In.
:- public stream_read/2.

stream_read(_, Line) :-
    thread_self(Me),
    running(Page, _, Me),
    flush_output(user_output),
    view_say_(Page, json([type=reads, what=line])),
    thread_get_message(ev3dev_view_goal(input(Text))),
    format(string(Said), "|: ~w", [Text]),
    note(goal, Said),
    string_concat(Text, "\n", Line).

%   There is nobody who could answer the tracer.
:- multifile user:prolog_trace_interception/4.
:- dynamic user:prolog_trace_interception/4.

user:prolog_trace_interception(_, _, _, nodebug) :-
    thread_self(Me),
    ev3dev_view_goals:running(_, _, Me),
    notrace,
    ev3dev_view_log:note(warning,
                         "A goal of a page cannot be traced. Type trace. at \c
                          the prompt of Prolog, and call the goal there.").

told(Word) :-
    thread_get_message(ev3dev_view_goal(Word)).

%!  goal_solve(+Text, +Page, +Number, +In, :Next) is det.
%
%   Solve a goal, as a part of the program; it reads from In, which is closed
%   then. After an answer that may not be the last one, call(Next, Word) waits
%   for `more`, for the next one, or `enough`. An abort is thrown again.

goal_solve(Text, Page, Number, In, Next) :-
    format(string(Line), "?- ~w", [Text]),
    note(goal, Line),
    tell_again,
    thread_self(Me),
    catch(setup_call_cleanup(
              true,
              solve_(Text, Number, Page, In, Next),
              ( part_ends(Me),
                close(In, [force(true)]) )),
          Error, unsolved(Error, Text, Page, Number)).

unsolved(rule_asked, _, Page, Number) :-
    !,
    answer(Page, Number, error,
           "A rule is no query: write it into the program, or type [user]. \c
            before it.").
unsolved(error(syntax_error(What), Context), Text, Page, Number) :-
    !,
    (   nonvar(Context),
        Context = stream(_, _, _, Place)
    ->  Error = error(syntax_error(What), string(Text, Place))
    ;   Error = error(syntax_error(What), _)
    ),
    error_text(Error, Why),
    answer(Page, Number, error, Why).
unsolved(Error0, _, Page, Number) :-
    Error0 = error(_, _),
    !,
    without_caller(Error0, Error),
    error_text(Error, Why),
    answer(Page, Number, error, Why).
unsolved(Ball, _, Page, Number) :-
    (   is_abort(Ball)
    ->  answer(Page, Number, stopped, "stopped")
    ;   format(string(Why), "Unknown exception: ~p", [Ball]),
        answer(Page, Number, error, Why)
    ).

%   What calls the goal is not of the program, nor does `(/)/2` call anything.
without_caller(error(Formal, context(Caller, Text)), Error) :-
    nonvar(Caller),
    (   memberchk(Caller, [ system:call_cleanup/2, system:'<meta-call>'/1,
                            ev3dev_frames:goal_of_program/1 ])
    ->  true
    ;   Formal = evaluation_error(_)
    ),
    !,
    Error = error(Formal, context(_, Text)).
without_caller(Error, Error).

is_abort('$aborted').
is_abort(unwind(abort)).

solve_(Text, Number, Page, In, Next) :-
    set_stream(In, alias(user_input)),
    set_input(In),
    thread_self(Me),
    term_string_with_names(Text, Term, Names),
    query(Term, Goal0),
    with_earlier(Goal0, Names, Goal),
    (   solution(Goal, Last),
        part_ends(Me),
        forall(( member(Name=Value, Names), nonvar(Value) ),
               ( retractall(earlier(Name, _)),
                 assertz(earlier(Name, Value)) )),
        bindings_text(Names, Answer),
        (   Last == true
        ->  answer(Page, Number, last, Answer)
        ;   answer(Page, Number, more, Answer),
            call(Next, Word),
            part_begins(Me),
            Word == enough
        )
    ->  true
    ;   part_ends(Me),
        answer(Page, Number, false, "false"),
        forall(failed(Goal), true)
    ).

%   Its sign may be typed, too.
query((?- Query), Query) :-
    !.
query((:- Query), Query) :-
    !.
query((_ :- _), _) :-
    !,
    throw(rule_asked).
query((_ --> _), _) :-
    !,
    throw(rule_asked).
query(Query, Query).

%   $X is the X of an answer before, as at the toplevel.

with_earlier(Term, Names, Earlier) :-
    (   \+ compound(Term)
    ->  Earlier = Term
    ;   Term = $(Variable),
        member(Name=Named, Names),
        Named == Variable
    ->  (   earlier(Name, Earlier)
        ->  true
        ;   throw(error(existence_error(answer, Name), _))
        )
    ;   Term =.. [Functor|Arguments],
        all_earlier(Arguments, Names, Earliers),
        Earlier =.. [Functor|Earliers]
    ).

all_earlier([], _, []).
all_earlier([Term|Terms], Names, [Earlier|Earliers]) :-
    with_earlier(Term, Names, Earlier),
    all_earlier(Terms, Names, Earliers).

solution(Goal, Last) :-
    call_cleanup(user:Goal, Deterministic = true),
    (   Deterministic == true
    ->  Last = true
    ;   Last = false
    ).

term_string_with_names(Text, Goal, Names) :-
    split_string(Text, "", " \t\r\n.", [Bare]),
    string_concat(Bare, " .", Ended),
    setup_call_cleanup(
        open_string(Ended, In),
        read_term(In, Goal, [variable_names(Names), module(user)]),
        close(In)),
    (   Goal == end_of_file
    ->  throw(error(syntax_error(end_of_file), _))
    ;   true
    ).

bindings_text(Names, Text) :-
    findall(Line,
            ( member(Name=Value, Names),
              \+ sub_atom(Name, 0, _, _, '_'),
              nonvar(Value),
              format(string(Line), "~w = ~W",
                     [ Name, Value,
                       [ quoted(true), portray(true), max_depth(500),
                         spacing(next_argument) ] ])
            ),
            Lines),
    (   Lines == []
    ->  Text = "true"
    ;   atomic_list_concat(Lines, ',\n', Text0),
        atom_string(Text0, Text)
    ).

%   The log has it, too, after what the goal printed.
answer(Page, Number, State, Text) :-
    (   State == error
    ->  note(error, Text)
    ;   note(answer, Text, State)
    ),
    atom_string(State, Word),
    view_say_(Page, json([type=answer, n=Number, state=Word, text=Text])).

note(Kind, Text, State) :-
    (   State == more
    ->  note(Kind, Text)
    ;   string_concat(Text, ".", Ended),
        note(Kind, Ended)
    ).
