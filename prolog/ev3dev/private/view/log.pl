:- module(ev3dev_view_log,
          [ watch_messages/0,
            leave_messages/0,
            mark/1,                     % +Term
            log_commands/1,             % +Ended
            note/2,                     % +Kind, +Text
            error_text/2,               % +Error, -Text
            lines_text/2                % +Lines, -Text
          ]).
:- use_module(library(lists), [member/2]).
:- use_module('../journal/journal_words', [cause_words//1, command_words//2]).
:- use_module('../journal/causes', [causes/2, follow/1, follow_no_more/0]).
:- use_module('../native/native',
              [ journal_new_/1, view_log_/6, view_printed_/3,
                view_serves_/0 ]).
:- use_module('../errors/error_texts', [item_said/3]).
:- use_module('../explain/error_messages', [in_words//1]).

/** <module> The log of the page

Commands, warnings and errors of the program, what it prints, its marks, rules
that become active, events that happen and Golog's history.
*/

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.
:- dynamic hook/1.                      % Clause

%!  watch_messages is det.
%!  leave_messages is det.
%
%   Note from now on what the program is warned of, and which rule or action
%   begins; and no more.

watch_messages :-
    leave_messages,
    asserta((user:message_hook(Message, Kind, Lines) :-
                 ev3dev_view_log:seen(Kind, Message, Lines),
                 fail),
            Hook),
    assertz(hook(Hook)),
    follow(ev3dev_view_log:begun).

leave_messages :-
    follow_no_more,
    forall(retract(hook(Hook)),
           erase(Hook)).

seen(Kind0, Message, Lines) :-
    (   message_kind(Kind0, Message, Kind),
        \+ view_serves_
    ->  lines_text(Lines, Text),
        note(Kind, Text)
    ;   true
    ).

message_kind(warning, _, warning).
message_kind(error, _, error).
%   What was asked for, as by why/1. Golog's history says what it executes.
message_kind(help, Message, output) :-
    Message \= golog(executing(_)),
    Message \= ev3dev(view(_)).

:- public begun/1.

begun(Cause) :-
    functor(Cause, Kind0, _),
    log_kind(Kind0, Kind),
    texts_of([Cause], [Text]),
    about([Cause], About),
    note(Kind, Text, About).

log_kind(rule, rule).
log_kind(event, rule).
log_kind(golog, golog).

%!  lines_text(+Lines, -Text) is det.
%
%   The lines of a message as a string.

lines_text(Lines, Text) :-
    with_output_to(string(Text0),
                   print_message_lines(current_output, '', Lines)),
    split_string(Text0, "", "\n ", [Text]).

%!  note(+Kind, +Text) is det.
%
%   A line in the log, after what was commanded and printed before.

note(Kind, Text) :-
    note(Kind, Text, []).

note(Kind, Text, About) :-
    thread_name(Thread),
    (   memberchk(Kind, [answer, error, stop])
    ->  Ended = true
    ;   Ended = false
    ),
    with_mutex(ev3dev_view_log,
               ( log_new(Ended),
                 view_log_(now, Kind, Text, [], About, Thread) )).

thread_name(page) :-
    view_serves_,
    !.
thread_name(Name) :-
    thread_self(Me),
    (   atom(Me)
    ->  Name = Me
    ;   integer(Me)
    ->  atom_number(Name, Me)
    ;   % <thread>(3,0x55d0)
        format(atom(Handle), "~w", [Me]),
        sub_atom(Handle, Before, 1, _, '('),
        sub_atom(Handle, End, 1, _, ','),
        Start is Before + 1,
        Length is End - Start,
        sub_atom(Handle, Start, Length, _, Name)
    ->  true
    ;   Name = ''
    ).

%!  mark(+Term) is det.
%
%   A line in the log.

mark(Term) :-
    (   ( atom(Term) ; string(Term) )
    ->  format(string(Text), "~w", [Term])
    ;   \+ \+ ( numbervars(Term, 0, _, [singletons(true)]),
                format(string(Text0), "~W",
                       [ Term,
                         [quoted(true), numbervars(true), max_depth(20)] ]),
                nb_setval(ev3dev_view_mark, Text0) ),
        nb_getval(ev3dev_view_mark, Text)
    ),
    note(mark, Text).

%!  log_commands(+Ended) is det.
%
%   Add what the program has commanded and printed meanwhile. Asks no device.
%   The beginning of a line is held back, unless Ended. What one thread has
%   taken stands in the log before another one adds to it.

log_commands(Ended) :-
    with_mutex(ev3dev_view_log, log_new(Ended)).

log_new(Ended) :-
    journal_new_(Done),
    view_printed_(Ended, Times, Texts),
    log_each(Done, Times, Texts).

log_each([done(Span, What-Command, Cause)|Done], Times, Texts) :-
    (   Times = [Time|_]
    ->  Span = span(At, _, _),
        At =< Time
    ;   true
    ),
    !,
    log_command(Command, What, Span, Cause),
    log_each(Done, Times, Texts).
log_each(Done, [Time|Times], [Text|Texts]) :-
    !,
    view_log_(Time, output, Text, [], [], ''),
    log_each(Done, Times, Texts).
log_each([], [], []).

log_command(Command0, What, Time, Cause) :-
    (   Command0 = ended(Reason, _)
    ->  Command = ended(Reason)
    ;   Command = Command0
    ),
    (   phrase(command_words(Command, What), Lines)
    ->  lines_text(Lines, Text),
        causes(Cause, Causes),
        texts_of(Causes, Texts),
        about([What|Causes], About),
        view_log_(Time, command, Text, Texts, About, '')
    ;   true
    ).

%   What a line is about, for the page's filter: `robot`, ports of motors,
%   rules and events.

about([], []).
about([Term|Terms], About) :-
    findall(Text, concerned(Term, Text), About, About1),
    about(Terms, About1).

concerned(robot(Left, Right), Text) :-
    member(Text, [robot, Left, Right]).
concerned(Port, Port) :-
    atom(Port),
    sub_atom(Port, 0, _, _, out).
concerned(rule(Name, _), Text) :-
    format(string(Text), "rule ~p", [Name]).
concerned(event(Id, _), Text) :-
    format(string(Text), "event ~p", [Id]).

texts_of([], []).
texts_of([Cause|Causes], [Text|Texts]) :-
    phrase(cause_words(Cause), Lines),
    lines_text(Lines, Text),
    texts_of(Causes, Texts).

%!  error_text(+Error, -Text) is det.
%
%   An error in words.

error_text(error(Formal, context(_, Message)), Text) :-
    nonvar(Message),
    atomic(Message),
    Message \== '',
    !,
    (   compound(Formal),
        Formal = domain_error(possible_geometry, Item)
    ->  item_said(Item, Message, Text)
    ;   format(string(Text), "~w", [Message])
    ).
error_text(Error, Text) :-
    catch(( in_words(Error, Lines, []),
            lines_text(Lines, Text) ),
          _, fail),
    !.
error_text(Error, Text) :-
    format(string(Text), "~q", [Error]).
