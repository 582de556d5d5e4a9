% Records whose fields have names, in a file that is compiled.

:- asserta(user:file_search_path(library, prolog)).

:- dynamic printed/1.

%   Messages are the errors and warnings of a module with this text.
compiled(Text, Messages) :-
    retractall(printed(_)),
    setup_call_cleanup(
        asserta((user:message_hook(Message, Kind, _) :-
                     memberchk(Kind, [error, warning]),
                     assertz(user:printed(Message))), Hook),
        setup_call_cleanup(
            open_string(Text, In),
            load_files(user:fields_tried, [stream(In), imports([])]),
            close(In)),
        erase(Hook)),
    findall(Message, printed(Message), Messages).

module_with(Clauses, Text) :-
    format(string(Text),
           ":- module(fields_tried, [shown/1]).
            :- use_module(library(ev3dev/private/basics/fields),
                          [fields/1, goal_expansion/2, term_expansion/2]).
            :- use_module(library(ev3dev/private/errors/public_clauses),
                          [term_expansion/4]).
            :- fields(wheel(port, diameter, inverted)).
            ~w", [Clauses]).

:- begin_tests(fields).
test(a_body_names_them, true(Goal-Messages =@= wheel(_, 5, _)-[])) :-
    module_with("shown(X) :- X = wheel(diameter: 5).", Text),
    compiled(Text, Messages),
    fields_tried:shown(Goal).
test(a_head_must_not,
     [ forall(member(Clause, [ "shown(_). p(wheel(diameter: 5)).",
                               "shown(_). p([wheel(port: P)], P).",
                               "shown(_). p(wheel(port: P)) :- atom(P).",
                               "shown(_). p(wheel(port: _)) --> [].",
                               "shown(wheel(port: P)) :- atom(P)." ])),
       true(Names == [wheel]) ]) :-
    module_with(Clause, Text),
    compiled(Text, Messages),
    findall(Name,
            member(error(permission_error(name_fields, head, Name), _), Messages),
            Names).
test(another_term_in_a_head, true(Messages == [])) :-
    module_with("shown(_). p(door(port: 1)). p(wheel(1, x:2, _)) :- true.", Text),
    compiled(Text, Messages).
:- end_tests(fields).
