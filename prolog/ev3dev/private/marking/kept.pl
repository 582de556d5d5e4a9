:- module(ev3dev_marking_kept,
          [ with_kept_runs/4,           % +Directory, +Resume, -Kept, :Goal
            kept_run/3,                 % +Kept, +Run, -Result
            keep_run/3,                 % +Kept, +Run, +Result
            writing/2                   % +File, :Goal
          ]).
:- use_module('../files/directory', [readable_file/3]).
:- use_module('../load/compiled', [contents/2, pack_folder/1]).
:- use_module(library(filesex),
              [directory_file_path/3, make_directory_path/1]).
:- use_module(library(lists), [member/2]).

:- meta_predicate
    with_kept_runs(+, +, -, 0),
    writing(+, 0).

/** <module> The results of runs, on disk as soon as they are there

The file `runs.pl` has a term kept(Key, Result) in each line. Key stands for
all that a result depends on, so the same run is not made again. A line that
is not whole, because the marker was killed, is left out. A run is run(Its,
World, Robot): the world and robot of the exercise, and what else a result
depends on.
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
with_kept_runs(Directory, Resume, kept(Out, Sources), Goal) :-
    pack_folder(Pack),
    sources(Pack, Sources),
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

%!  kept_run(+Kept, +Run, -Result) is semidet.

kept_run(kept(_, Sources), Run, Result) :-
    key(Sources, Run, Key),
    known(Key, Result),
    !.

%!  keep_run(+Kept, +Run, +Result) is det.

keep_run(kept(Out, Sources), Run, Result) :-
    key(Sources, Run, Key),
    stream_property(Out, file_name(New)),       % its name before
    atom_concat(File, '.new', New),
    writing(File, ( write_run(Out, Key, Result), flush_output(Out) )).

%!  writing(+File, :Goal) is det.
%
%   Call Goal once. If a disk is full, the error names File, not a stream.

writing(File, Goal) :-
    catch(Goal, error(io_error(write, _), Context),
          throw(error(io_error(write, File), Context))),
    !.

key(Sources, Run, Key) :-
    Run = run(_, World, Robot),
    named_file(World, WorldFile),
    named_file(Robot, RobotFile),
    variant_sha1(key(Sources, Run, WorldFile, RobotFile), Key).

%   What a file of a world or robot has, if Name names one.

named_file(Name, Contents) :-
    (   atomic(Name),
        readable_file(Name, pl, File)
    ->  contents(File, Contents)
    ;   Contents = none
    ).

%   The files of the pack, and those that are loaded here and are not
%   Prolog's: the exercise, and what it loads.

sources(Pack, Hash) :-
    findall(Name-Contents,
            ( member(Folder, [prolog, lib, native]),
              directory_file_path(Pack, Folder, Path),
              within(Path, File),
              atom_concat(Pack, Name, File),
              contents(File, Contents) ),
            Packed),
    current_prolog_flag(home, Home),
    directory_file_path(Pack, prolog, Own),
    findall(File-Contents,
            (   ( source_file(File)
                ; source_file(By),
                  source_file_property(By, includes(File, _)) ),
                \+ ( member(Folder, [Home, Own]),
                     sub_atom(File, 0, _, _, Folder) ),
                exists_file(File),
                contents(File, Contents) ),
            Loaded0),
    sort(Loaded0, Loaded),
    variant_sha1(Packed-Loaded, Hash).

within(Path, File) :-
    (   exists_directory(Path)
    ->  directory_files(Path, Names0),
        msort(Names0, Names),
        member(Name, Names),
        \+ sub_atom(Name, 0, _, _, '.'),
        directory_file_path(Path, Name, Path1),
        within(Path1, File)
    ;   exists_file(Path),
        File = Path
    ).
