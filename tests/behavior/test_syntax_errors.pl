:- use_module('../support/trees').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/golog), [op(_, _, _)]).
:- use_module(library(ev3dev/rules), [op(_, _, _)]).
:- use_module(library(ev3dev/layers), [op(_, _, _)]).
:- use_module(library(ev3dev/private/errors/message_text)).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(plunit)).
:- use_module(library(readutil)).

% What is said about a clause that Prolog cannot read.

%   A program after `start :-`, and the advice.
wrong("\n    go(20)\n    wait(1).",
      'a comma may be missing at the end of line 2').
wrong("\n    go(20),\n    wait(1)\nnext :-\n    stop.",
      'a full stop may be missing at the end of line 3').
wrong("\n    go(20),\n    wait(1),\nnext :-\n    stop.",
      'a full stop, not a comma, belongs at the end of line 3').
wrong(" stop.\ncolor(red)\ncolor(blue).",
      'a full stop may be missing at the end of line 2').
wrong("\ngo(20)\nwait(1).",
      'a comma or a full stop may be missing at the end of line 2').
wrong("\n    go(20)", 'a full stop is missing at the end of line 2').
wrong("\n    go(20);\n", 'something is missing at the end of line 2').
wrong(" Go(20).", 'names of predicates begin with a small letter: Go(').
wrong(" wait(1), go (20).", 'write go( without a space').
wrong(" go(20)(30).", 'a name takes one pair of parentheses').
wrong(" motor_run[outB, 50].",
      'arguments are in round parentheses: motor_run(').
wrong(" wait(1), go 20.", 'arguments are in parentheses: go(20)').
wrong(" motor_run(outB 50).", 'a comma may be missing between outB and 50').
wrong(" say(hello world).", 'a comma may be missing between hello and world').
wrong(" wait(1s).", 'a comma may be missing between 1 and s').
wrong(" go(.5).", 'write 0.5').
wrong("\n  go(20,\n  wait(1).\nx.", 'the ( in line 2 is not closed').
wrong("\n  X = [1, 2,\n  go(X).\nx.", 'the [ in line 2 is not closed').
wrong(" go(20), stop).", 'there is no ( for the ) in line 1').
wrong(" go(20], stop.", 'the ( in line 1 is closed by ] in line 1').
wrong("\n  say('hello),\n  wait(1).\nx.", 'the \' in line 2 has no end').
wrong(" say(\"hello).\nx.", 'the " in line 1 has no end').
wrong(" /* drive\n  go(20).", 'the /* in line 1 has no end').
wrong(" stop,.", 'there is a comma before the full stop').
wrong(" stop,, stop.", 'something is missing between , and ,').
wrong(" motor_run(outB, ).", 'something is missing between , and )').
wrong(" say(\u201Chello\u201D).", 'write " instead of \u201C').
wrong(" X is 3 \u2013 2, say(X).", 'write - instead of \u2013').
wrong(" X <= 3.", 'write =< instead of <=').
wrong(" X => 3.", 'write >= instead of =>').
wrong(" X != 3.", 'write \\== instead of !=').
wrong(" X += 1.",
      'Prolog has no +=, since a variable keeps its value: X1 is X+1').
wrong(" stop and stop.", 'write , instead of and').
wrong(" stop && stop.", 'write , instead of &&').
wrong(" not stop.", 'write \\+ instead of not').
wrong(" if stop then stop else stop.",
      'Prolog has no if: ( Condition -> Then ; Else )').
% Neither a comment nor what is between quotes is looked at.
wrong(" % (\n  say('it''s (', \"a\\\"b\", 0'(, 0'', 0'\\n), stop stop.",
      'a comma may be missing between stop and stop').


%   said(+Program, -Advice): Advice is about its first clause with an error,
%   `none` if no clause has one, and `silent` if Prolog alone says something.

said(Program, Advice) :-
    setup_call_cleanup(
        tmp_file(program, File),
        ( in_file(File, write, Out, write(Out, Program)),
          in_file(File, read, In, first_error(In, File, Error)),
          advice(Error, File, Advice) ),
        catch(delete_file(File), _, true)).

in_file(File, Mode, Stream, Goal) :-
    setup_call_cleanup(open(File, Mode, Stream, [encoding(utf8)]),
                       Goal,
                       close(Stream)).

first_error(In, File, Error) :-
    catch(read_term(In, Term, [module(user)]), error(Formal, At), true),
    (   nonvar(Formal)
    ->  At =.. [_, _, Line, Column, Char],
        Error = error(Formal, file(File, Line, Column, Char))
    ;   Term == end_of_file
    ->  Error = none
    ;   first_error(In, File, Error)
    ).

advice(none, _, none).
advice(error(Formal, At), File, Advice) :-
    message_text(error(Formal, At), Text),
    atom_concat(File, Said, Text),
    atomic_list_concat([_, _, _|Parts], ':', Said),
    (   Parts = [' Syntax error'|_]
    ->  Advice = silent
    ;   Parts = [_|Rest],
        atomic_list_concat(Rest, ':', Rest1),
        atom_concat(' ', Advice, Rest1)
    ).

%   without(+End, +Text0, -Text, -Number) is nondet: line Number of Text0 ends
%   with End, and that of Text does not.

without(End, Text0, Text, Number) :-
    split_string(Text0, "\n", "", Lines0),
    append(Lines1, [Line0|Lines2], Lines0),
    string_concat(Line, End, Line0),
    Line \== "",
    \+ sub_string(Line, _, _, _, "%"),
    append(Lines1, [Line|Lines2], Lines),
    length([_|Lines1], Number),
    atomic_list_concat(Lines, '\n', Text).

:- begin_tests(syntax_errors).
test(mistakes_of_beginners,
     [ forall(wrong(Text, Advice)), true(Said == Advice) ]) :-
    string_concat("start :-", Text, Program),
    said(Program, Said).
test(a_clause_begins_with_a_variable,
     Advice == 'a clause begins with a variable: names of predicates begin \c
                with a small letter') :-
    catch('$record_clause'((_ :- true), user, _), Error, true),
    message_text(Error, Advice).
test(a_clause_has_no_head,
     [ forall(member(Clause, [(start -> go(3)), (go(3), stop), (a ; b)])),
       true(sub_atom(Advice, 0, _, _, 'this clause has no head: ')) ]) :-
    catch(assertz(Clause), error(Formal, _), true),
    message_text(error(Formal, _), Advice).
test(a_clause_is_of_a_predicate_of_prolog,
     true(sub_atom(Advice, 0, _, _, 'atom_length/2 is one of Prolog\'s own'))) :-
    catch(assertz((atom_length(_, _) :- true)), error(Formal, _), true),
    message_text(error(Formal, _), Advice).
test(a_program_changes_a_static_predicate_of_its_own,
     true(sub_atom(Advice, _, _, _, 'No permission'))) :-
    message_text(error(permission_error(modify, static_procedure, user:wrong/2),
                       _), Advice).
test(a_command_stands_alone,
     true(sub_atom(Advice, 0, _, _, 'go_cm/2 is a predicate of the pack'))) :-
    message_text(ignored_weak_import(user, ev3dev_robot:go_cm/2), Advice).
test(a_number_is_divided_by_zero, Advice == 'a number is divided by 0') :-
    message_text(error(evaluation_error(zero_divisor), _), Advice).
test(a_program_has_lost_what_ended_a_line,
     [ forall(member(End, [",", "."])), true(More > 100+100*Less) ]) :-
    expand_file_name('examples/*.pl', Examples),
    expand_file_name('course/*/*.pl', Course),
    append(Examples, Course, Files),
    findall(Right,
            ( member(File, Files),
              \+ sub_atom(File, _, _, _, classic),      % not is an operator
              \+ sub_atom(File, _, _, _, brick_check),  % #!
              read_file_to_string(File, Text0, []),
              without(End, Text0, Text, Number),
              said(Text, Said),
              \+ memberchk(Said, [none, silent]),
              format(atom(Line), 'the end of line ~d', [Number]),
              ( sub_atom(Said, _, _, 0, Line) -> Right = true
              ; Right = false ) ),
            All),
    partition(==(true), All, Rights, Wrongs),
    length(Rights, More),
    length(Wrongs, Less).
:- end_tests(syntax_errors).
