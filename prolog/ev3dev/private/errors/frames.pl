:- module(ev3dev_frames,
          [ called_by_program/2,        % -Frame, -Called
            goal_of_program/1,          % :Goal
            goal_of_program/2,          % :Goal, +Label
            in_pack/3,                  % +Predicate, -Module, -Indicator
            is_of_system/1,             % +Predicate
            is_public/2,                % ?Module, +Indicator
            program/1                   % ?File
          ]).

/** <module> The frames between an error and the program

The walk begins at the frame of the error and goes outward to the program's
own code. It takes the last exported predicate of the pack. Only an error pays
for it.
*/

:- meta_predicate
    goal_of_program(0),
    goal_of_program(0, +).

%!  goal_of_program(:Goal) is nondet.
%!  goal_of_program(:Goal, +Label) is nondet.
%
%   Call a Goal of the program. Its errors name the predicate that Goal
%   called, and not the one that calls Goal. While library(ev3dev/reasoning)
%   records the program, it records Goal, too, below a row with the Label.

goal_of_program(Goal) :-
    (   nb_current(ev3dev_reasoning, Node),
        Node \== []
    ->  recorded(Node, Goal)
    ;   call(Goal)
    ),
    true.

goal_of_program(Goal, Label) :-
    (   nb_current(ev3dev_reasoning, Node),
        Node \== []
    ->  labelled(Node, Label, Goal)
    ;   call(Goal)
    ),
    true.

%   What calls a goal of the program: no walk goes on beyond it. The recorder
%   adds its own.

:- multifile
    labelled/3,                         % Node, Label, Goal
    recorded/2,                         % Node, Goal
    calls_program/1.                    % Indicator
:- dynamic labelled/3, recorded/2.

calls_program(goal_of_program/1).       % of this module
calls_program(goal_of_program/2).

%!  called_by_program(-Frame, -Called) is semidet.
%
%   Called is the exported predicate, Name/Arity, that the program has called,
%   and Frame is the frame of this call.

called_by_program(Frame, Called) :-
    prolog_current_frame(Current),
    called(Current, none, Found),
    Found = Frame-Called.

%   The last exported predicate of the pack between Frame and the program.

called(Frame, Called0, Called) :-
    prolog_frame_attribute(Frame, predicate_indicator, Indicator),
    (   calls_program(Indicator)
    ->  Called = Called0
    ;   in_pack(Indicator, Module, Predicate)
    ->  (   is_public(Module, Predicate)
        ->  Called1 = Frame-Predicate
        ;   Called1 = Called0
        ),
        outwards(Frame, Called1, Called)
    ;   is_of_system(Indicator)
    ->  outwards(Frame, Called0, Called)
    ;   Called = Called0
    ).

outwards(Frame, Called0, Called) :-
    (   prolog_frame_attribute(Frame, parent, Parent)
    ->  called(Parent, Called0, Called)
    ;   Called = Called0
    ).

%   The tracer shows what a program calls, and not what the pack calls for it:
%   also what native code or a system predicate calls, where Prolog forgets
%   that the pack is hidden.

:- multifile user:prolog_trace_interception/4.
:- dynamic user:prolog_trace_interception/4.
:- initialization(
       asserta((user:prolog_trace_interception(_, Frame, _, continue) :-
                    ev3dev_frames:is_inner(Frame))),
       now).

is_inner(Frame) :-
    prolog_frame_attribute(Frame, predicate_indicator, Indicator),
    passes(Indicator),
    prolog_frame_attribute(Frame, parent, Parent),
    is_inside(Parent).

is_inside(Frame) :-
    prolog_frame_attribute(Frame, predicate_indicator, Indicator),
    (   calls_program(Indicator)
    ->  fail
    ;   in_pack(Indicator, _, _)
    ->  true
    ;   passes(Indicator),
        prolog_frame_attribute(Frame, parent, Parent),
        is_inside(Parent)
    ).

%   The predicate is not that of a program, as a hook of Prolog is not.

passes(Indicator) :-
    (   in_pack(Indicator, _, _)
    ->  true
    ;   is_of_system(Indicator)
    ->  true
    ;   Indicator = Module:Name/Arity,
        functor(Head, Name, Arity),
        predicate_property(Module:Head, multifile),
        \+ ( predicate_property(Module:Head, file(File)), program(File) )
    ).

%!  in_pack(+Indicator, -Module, -Predicate) is semidet.
%
%   True if Indicator, that of a frame, is Module:Predicate of the pack.

in_pack(Module:Predicate, Module, Predicate) :-
    sub_atom(Module, 0, _, _, ev3dev).

%!  is_public(?Module, +Predicate) is semidet.
%
%   True if a public library exports the Predicate of Module, Name/Arity. The
%   library may import it from a private module.

is_public(Module, Name/Arity) :-
    functor(Head, Name, Arity),
    predicate_property(Module:Head, exported),
    current_module(Library),
    sub_atom(Library, 0, _, _, ev3dev),
    module_property(Library, file(File)),
    \+ sub_atom(File, _, _, _, '/private/'),
    module_property(Library, exports(Exports)),
    memberchk(Name/Arity, Exports),
    (   Library == Module
    ->  true
    ;   predicate_property(Library:Head, imported_from(Module))
    ),
    !.

%!  is_of_system(+Indicator) is semidet.
%
%   True if Indicator, that of a frame, is one of Prolog's own predicates.

is_of_system(_/_).
is_of_system(Module:_) :-
    module_property(Module, class(Class)),
    memberchk(Class, [system, library]).

%!  program(?File) is nondet.
%
%   True if File is loaded, and is neither Prolog's nor the pack's.

program(File) :-
    source_file(File),
    \+ ( (   current_prolog_flag(home, Folder)
         ;   module_property(ev3dev, file(Ev3dev)),
             file_directory_name(Ev3dev, Folder)
         ),
         sub_atom(File, 0, _, _, Folder)
       ),
    \+ ( source_file_property(File, module(Module)),
         in_pack(Module:File, _, _)     % of a page, or not in its folder
       ).
