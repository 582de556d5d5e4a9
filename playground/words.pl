% Prints what the editor offers of the pack: of each predicate its name, how it is called, and its
% first sentence, as JSON.
%
%   swipl -p library=prolog playground/words.pl

:- use_module(library(ev3dev)).
:- use_module(library(http/json)).
:- use_module('../prolog/ev3dev/private/help/help_index').

words :-
    ev3dev_help_index:read_comments,
    findall(json([name=Name, template=Template, about=About]),
            word(Name, Template, About),
            Words0),
    sort(Words0, Words),
    json_write(current_output, Words, [width(0)]),
    nl.

word(Name, Template, About) :-
    ev3dev_help_index:predicate_(Name, _, Id),
    ev3dev_help_index:comment_(Id, Library, Heads, Body),
    member(Head, Heads),
    split_string(Head, "(", " ", [NameText|_]),
    atom_string(Name, NameText),
    atomic_list_concat([Template|_], ' is ', Head),
    ev3dev_help_index:summary(Body, Summary),
    (   Library == ev3dev
    ->  About = Summary
    ;   format(string(About), "~w In library(~w).", [Summary, Library])
    ).

:- initialization((words, halt)).
