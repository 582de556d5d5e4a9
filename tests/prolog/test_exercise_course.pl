% The exercises of the course: the solution earns all points, the skeleton few, and a classic
% mistake what a teacher would give.

:- use_module('../support/cases').
:- use_module('../support/child', [starts_itself/0]).
:- use_module('../support/course_mistakes').
:- use_module('../support/trees').
:- use_module('../support/same_reasons').
:- use_module(library(ev3dev/exercise)).
:- use_module(library(filesex), [delete_directory_and_contents/1]).

course(Folder, Exercise) :-
    source_file(course(_, _), This),
    file_directory_name(This, Tests),
    atom_concat(Tests, '/../../course/*/exercise.pl', Pattern),
    expand_file_name(Pattern, Files),
    member(Exercise, Files),
    file_directory_name(Exercise, Path),
    file_base_name(Path, Folder).

%   Exercise is the file, and Text that of the program.
text_of(Exercise, Of, Edits, Text) :-
    file_directory_name(Exercise, Path),
    format(atom(File), '~w/~w.pl', [Path, Of]),
    read_file_to_string(File, Text0, [encoding(utf8)]),
    foldl(edited, Edits, Text0, Text).

edited(Old-New, Text0, Text) :-
    findall(Before-After, sub_string(Text0, Before, _, After, Old), Places),
    (   Places = [Before-After]
    ->  true
    ;   throw(error(not_once_in_the_program(Old), _))
    ),
    sub_string(Text0, 0, Before, _, Head),
    sub_string(Text0, _, After, 0, Tail),
    string_concat(Head, New, Text1),
    string_concat(Text1, Tail, Text).

%   The solution, and with few cases some of the others.
tried(Folder, solution, Of, Edits) :-
    course_program(Folder, solution, Of, Edits, _, _).
tried(Folder, Name, Of, Edits) :-
    some(( course_program(Folder, Name, Of, Edits, _, _), Name \== solution )).

%   Programs has Name-File for each program of that exercise, while Goal is called.
:- meta_predicate with_programs(+, +, -, 0).

with_programs(Folder, Exercise, Programs, Goal) :-
    tmp_file(course, Directory),
    make_directory(Directory),
    findall(Name-File,
            ( tried(Folder, Name, Of, Edits),
              text_of(Exercise, Of, Edits, Text),
              format(atom(File), '~w/~w.pl', [Directory, Name]),
              setup_call_cleanup(open(File, write, Out, [encoding(utf8)]),
                                 write(Out, Text),
                                 close(Out)) ),
            Programs),
    call_cleanup(once(Goal), delete_directory_and_contents(Directory)).

%   What programs of that exercise earn that deserve more or less.
unfair(Folder, Exercise, Options, Unfair) :-
    with_programs(Folder, Exercise, Programs,
        ( findall(File, member(_-File, Programs), Files),
          exercise_mark(Exercise, Files, Options, Marks) )),
    findall(earns(Name, Points, Deserved, Why, Runs),
            ( member(mark(Name, Points, _, _, Runs, _), Marks),
              course_program(Folder, Name, _, _, Deserved, Why),
              Deserved = Least-Most,
              \+ ( Points >= Least, Points =< Most ) ),
            Unfair).

:- begin_tests(exercise_course, [condition(starts_itself)]).
test(each_program_earns_what_it_deserves, [forall(course(Folder, Exercise)), Unfair == []]) :-
    (   all_cases
    ->  Options = []
    ;   Options = [seeds(5)]
    ),
    unfair(Folder, Exercise, Options, Unfair).
test(try_says_what_mark_says, [forall(course(Folder, Exercise)), Unlike == []]) :-
    Options = [seeds(5), enclosed(false)],
    with_programs(Folder, Exercise, Programs,
        ( findall(File, member(_-File, Programs), Files),
          marked_reasons(Exercise, Files, Options, Reasons),
          findall(Name-said(Tried, Reason),
                  ( nth1(N, Programs, Name-File),
                    nth1(N, Reasons, Reason),
                    said_by_try(Exercise, File, Options, Text),
                    tried_reason(Text, Tried),
                    Tried \== Reason ),
                  Unlike) )).
test(each_exercise_has_five_mistakes, [forall(course(Folder, _))]) :-
    findall(Name, ( course_program(Folder, Name, _, _, _-Most, _), Most < 10, Name \== skeleton ),
            Names),
    sort(Names, Different),
    length(Different, Count),
    assertion(Count >= 5).
:- end_tests(exercise_course).
