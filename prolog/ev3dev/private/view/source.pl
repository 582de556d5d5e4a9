:- module(ev3dev_view_source,
          [ source_line/4,              % +Word, +Rest, +Page, -Answer
            source_leave/1,             % +Page
            renew_active/0,
            program_directory/1         % -Directory
          ]).
:- use_module(library(lists), [last/2, member/2]).
:- use_module('../journal/causes', [active_clause/1]).
:- use_module('../native/native', [view_keep_/2]).
:- use_module(program, [in_main/1, program_state/1]).

/** <module> The text of the program, and what of it is active

While a page shows the text, a signal asks the main thread some times in a
second which clauses it is in. Between two of its goals it looks at its own
frames, and at the rule of behave/1,2 that is active. Nothing in the program
changes for it.
*/

:- dynamic
    reader/1,                           % Page
    asked/1,                            % Time
    looked/1,                           % Time
    seen/1.                             % Json

%   The seconds between two looks at the program, and the most frames of a
%   look and clauses of an answer.
every(0.1).
most_frames(200).
most_clauses(8).

%   The longest file that a page gets, in bytes.
longest(200000).

% ---------------- TEXT

%!  source_line(+Word, +Rest, +Page, -Answer) is semidet.
%
%   A page wants to read the program, one of its files, or no more. Answer is
%   done(More) or refused(Why). Fails if that is not a line.

source_line(program, Rest, Page, Answer) :-
    (   Rest == "off"
    ->  source_leave(Page),
        Answer = done([])
    ;   text_answer(Rest, Answer0),
        (   Answer0 = done(_)
        ->  source_leave(Page),
            assertz(reader(Page))
        ;   true
        ),
        Answer = Answer0
    ).

text_answer("", Answer) :-
    !,
    (   program_file(File)
    ->  text_of(File, Answer)
    ;   Answer = refused("No program is loaded.")
    ).
text_answer(Text, Answer) :-
    atom_string(File, Text),
    (   source_file(File),
        is_programs(File)
    ->  text_of(File, Answer)
    ;   format(string(Why), "~w is no file of the program.", [File]),
        Answer = refused(Why)
    ).

text_of(File, Answer) :-
    longest(Longest),
    (   catch(size_file(File, Size), error(_, _), fail)
    ->  (   Size > Longest
        ->  Answer = refused("The program is too long for a page.")
        ;   setup_call_cleanup(
                open(File, read, In, [encoding(utf8)]),
                read_string(In, _, Text),
                close(In)),
            findall(Name,
                    ( programs_file(Other),
                      atom_string(Other, Name) ),
                    Files),
            atom_string(File, Path),
            is_older(File, Older),
            Answer = done([ file=Path, text=Text, files=Files,
                            older=Older ])
        )
    ;   format(string(Why), "~w is not there any more.", [File]),
        Answer = refused(Why)
    ).

%   What runs was loaded before the file was changed.
is_older(File, Older) :-
    (   source_file_property(File, modified(Loaded)),
        catch(time_file(File, Changed), error(_, _), fail),
        Changed > Loaded + 1
    ->  Older = true
    ;   Older = false
    ).

%   The file that was loaded last, and not by another one.
program_file(File) :-
    findall(File0,
            ( programs_file(File0),
              \+ included(File0) ),
            Files),
    last(Files, File).

programs_file(File) :-
    source_file(File),
    is_programs(File).

%   Neither of this pack nor of Prolog's own libraries.
is_programs(File) :-
    \+ ( library(Folder),
         sub_atom(File, 0, _, _, Folder) ).

library(Home) :-
    current_prolog_flag(home, Home).
library(Folder) :-
    module_property(ev3dev_view_source, file(Here)),
    sub_atom(Here, Before, _, 0, '/ev3dev/private/view/source.pl'),
    sub_atom(Here, 0, Before, _, Prolog),
    (   Folder = Prolog
    ;   file_directory_name(Prolog, Pack),
        member(Name, ['/app', '/compiled']),
        atom_concat(Pack, Name, Folder)
    ).

included(File) :-
    source_file_property(File, load_context(_, Parent:_, _)),
    is_programs(Parent).

%!  program_directory(-Directory) is det.
%
%   Where the program is; without a program, where Prolog works.

program_directory(Directory) :-
    (   program_file(File)
    ->  file_directory_name(File, Directory)
    ;   working_directory(Directory0, Directory0),
        (   atom_concat(Directory, /, Directory0),
            Directory \== ''
        ->  true
        ;   Directory = Directory0
        )
    ).

% ---------------- ACTIVE

%!  source_leave(+Page) is det.
%
%   This page shows the program no more.

source_leave(Page) :-
    retractall(reader(Page)),
    (   reader(_)
    ->  true
    ;   retractall(asked(_)),
        retractall(seen(_)),
        view_keep_(active, [])
    ).

%!  renew_active is det.
%
%   If a page shows the program, send what was active when it was asked last,
%   and ask again if it is time. It is asked only after it has answered.

renew_active :-
    (   reader(_)
    ->  renew_loaded,
        program_state(State),
        (   State == idle
        ->  retractall(seen(_)),
            retractall(asked(_)),
            view_keep_(active, [])
        ;   (   retract(seen(Active))
            ->  view_keep_(active, Active)
            ;   true
            ),
            with_mutex(ev3dev_view_source, ask)
        )
    ;   true
    ).

%   A number that changes when a file of the program is loaded again.
renew_loaded :-
    get_time(Now),
    (   looked(Last),
        abs(Now - Last) < 1
    ->  true
    ;   retractall(looked(_)),
        assertz(looked(Now)),
        findall(File-Time,
                ( programs_file(File),
                  source_file_property(File, modified(Time)) ),
                Files),
        term_hash(Files, Hash),
        view_keep_(loaded, Hash)
    ).

ask :-
    get_time(Now),
    every(Every),
    (   asked(Last),
        (   Last == waits
        ;   abs(Now - Last) < Every
        )
    ->  true
    ;   retractall(asked(_)),
        assertz(asked(waits)),
        in_main(ev3dev_view_source:look)
    ).

%   In the main thread.
:- public look/0.

look :-
    get_time(Now),
    (   catch(active(Active), error(_, _), fail)
    ->  true
    ;   Active = []
    ),
    retractall(seen(_)),
    assertz(seen(Active)),
    (   retract(asked(waits))
    ->  assertz(asked(Now))
    ;   true
    ).

active(Active) :-
    prolog_current_frame(Frame),
    most_frames(Frames),
    most_clauses(Clauses),
    clauses(Frame, '', Frames, Clauses, Active0),
    (   rule(Rule)
    ->  Active = [Rule|Active0]
    ;   Active = Active0
    ).

%   clauses(+Frame, +Called, +Frames, +Clauses, -Active): the clauses of the
%   program in which Frame and its parents are, each with what it called.
clauses(Frame, Called, Frames, Clauses, Active) :-
    (   Frames =:= 0
    ->  Active = []
    ;   Clauses =:= 0
    ->  Active = []
    ;   (   prolog_frame_attribute(Frame, clause, Clause),
            place(Clause, File, Line)
        ->  Active = [ json([file=File, line=Line, goal=Called]) | Active1 ],
            Clauses1 is Clauses - 1
        ;   Active = Active1,
            Clauses1 = Clauses
        ),
        (   prolog_frame_attribute(Frame, parent, Parent)
        ->  name_of(Frame, Name),
            Frames1 is Frames - 1,
            clauses(Parent, Name, Frames1, Clauses1, Active1)
        ;   Active1 = []
        )
    ).

name_of(Frame, Name) :-
    prolog_frame_attribute(Frame, goal, Goal0),
    strip_module(Goal0, _, Goal),
    functor(Goal, Name0, _),
    atom(Name0),
    !,
    atom_string(Name0, Name).
name_of(_, "").

place(Clause, File, Line) :-
    clause_property(Clause, file(File0)),
    is_programs(File0),
    clause_property(Clause, line_count(Line)),
    atom_string(File0, File).

rule(json([file=File, line=Line, goal="", rule=true])) :-
    active_clause(Clause),
    place(Clause, File, Line).
