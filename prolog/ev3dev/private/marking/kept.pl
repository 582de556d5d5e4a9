:- module(ev3dev_marking_kept,
          [ with_kept_runs/4,           % +Directory, +Resume, -Kept, :Goal
            kept_run/3,                 % +Kept, +Key, -Result
            keep_run/3                  % +Kept, +Key, +Result
          ]).
:- use_module(library(filesex),
              [directory_file_path/3, make_directory_path/1]).

:- meta_predicate with_kept_runs(+, +, -, 0).

/** <module> The results of runs, on disk as soon as they are there

The file `runs.pl` has a term kept(Key, Result) in each line. Key stands for
all that a result depends on, so the same run is not made again. A line that
is not whole, as of a marker that was killed, is left out.
*/

:- dynamic known/2.                     % Key, Result
:- volatile known/2.

%!  with_kept_runs(+Directory, +Resume, -Kept, :Goal) is semidet.
%
%   Call Goal once, while Kept stands for the file in Directory, or for none
%   if that is `none`. What is there already is forgotten, unless Resume is
%   true.
%
%   @error permission_error(_, _, _) if the file cannot be written

with_kept_runs(none, _, none, Goal) :-
    !,
    once(Goal).
with_kept_runs(Directory, Resume, kept(Out), Goal) :-
    make_directory_path(Directory),
    directory_file_path(Directory, 'runs.pl', File),
    retractall(known(_, _)),
    (   Resume == true,
        exists_file(File)
    ->  setup_call_cleanup(open(File, read, In, [encoding(utf8)]),
                           learn(In),
                           close(In))
    ;   true
    ),
    atom_concat(File, '.new', New),
    setup_call_cleanup(
        open(New, write, Out, [encoding(utf8)]),
        ( forall(known(Key, Result), write_run(Out, Key, Result)),
          flush_output(Out),
          rename_file(New, File),
          once(Goal) ),
        close(Out, [force(true)])).

learn(In) :-
    repeat,
    catch(read_term(In, Term, []), error(syntax_error(_), _), Term = none),
    (   Term == end_of_file
    ->  !
    ;   Term = kept(Key, Result),
        ground(Term)
    ->  assertz(known(Key, Result)),
        fail
    ;   fail
    ).

write_run(Out, Key, Result) :-
    format(Out, '~k.~n', [kept(Key, Result)]).

%!  kept_run(+Kept, +Key, -Result) is semidet.

kept_run(kept(_), Key, Result) :-
    known(Key, Result),
    !.

%!  keep_run(+Kept, +Key, +Result) is det.

keep_run(none, _, _).
keep_run(kept(Out), Key, Result) :-
    write_run(Out, Key, Result),
    flush_output(Out).
