:- module(ev3dev_view_log,
          [ watch_messages/0,
            leave_messages/0,
            mark/1,                     % +Term
            log_commands/0,
            error_text/2                % +Error, -Text
          ]).
:- use_module('../journal_words', [cause_words//1, command_words//2]).
:- use_module('../causes', [causes/2, follow/1, follow_no_more/0]).
:- use_module('../native', [journal_new_/1, view_log_/5, view_serves_/0]).
:- use_module('../uncaught', [in_words//1]).

/** <module> What the page's log is told

Commands, warnings and errors of the program, its marks, rules that become
active, events that happen and Golog's history.
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
    asserta((user:message_hook(_, Kind, Lines) :-
                 ev3dev_view_log:seen(Kind, Lines),
                 fail),
            Hook),
    assertz(hook(Hook)),
    follow(ev3dev_view_log:begun).

leave_messages :-
    follow_no_more,
    forall(retract(hook(Hook)),
           erase(Hook)).

seen(Kind, Lines) :-
    (   memberchk(Kind, [warning, error]),
        \+ view_serves_
    ->  lines_text(Lines, Text),
        note(Kind, Text)
    ;   true
    ).

:- public begun/1.

begun(Cause) :-
    functor(Cause, Kind0, _),
    log_kind(Kind0, Kind),
    texts_of([Cause], [Text]),
    note(Kind, Text).

log_kind(rule, rule).
log_kind(event, rule).
log_kind(golog, golog).

lines_text(Lines, Text) :-
    with_output_to(string(Text0),
                   print_message_lines(current_output, '', Lines)),
    split_string(Text0, "", "\n ", [Text]).

note(Kind, Text) :-
    thread_name(Thread),
    % What was commanded before stands before it.
    log_commands,
    view_log_(now, Kind, Text, [], Thread).

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

%!  log_commands is det.
%
%   Add what the program has commanded meanwhile. Asks no device.

log_commands :-
    journal_new_(Done),
    log_each(Done).

log_each([]).
log_each([done(Time, What-Command0, Cause)|Done]) :-
    (   Command0 = ended(Reason, _)
    ->  Command = ended(Reason)
    ;   Command = Command0
    ),
    (   phrase(command_words(Command, What), Lines)
    ->  lines_text(Lines, Text),
        causes(Cause, Causes),
        texts_of(Causes, Texts),
        view_log_(Time, command, Text, Texts, '')
    ;   true
    ),
    log_each(Done).

texts_of([], []).
texts_of([Cause|Causes], [Text|Texts]) :-
    phrase(cause_words(Cause), Lines),
    lines_text(Lines, Text),
    texts_of(Causes, Texts).

%!  error_text(+Error, -Text) is det.
%
%   What a person is told of an error.

error_text(error(Formal, context(_, Message)), Text) :-
    nonvar(Message),
    atomic(Message),
    Message \== '',
    !,
    (   compound(Formal),
        Formal = domain_error(possible_geometry, Item)
    ->  format(string(Text), "~w ~w", [Item, Message])
    ;   format(string(Text), "~w", [Message])
    ).
error_text(Error, Text) :-
    catch(( in_words(Error, Lines, []),
            lines_text(Lines, Text) ),
          _, fail),
    !.
error_text(Error, Text) :-
    format(string(Text), "~q", [Error]).
