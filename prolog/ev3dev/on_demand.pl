:- module(ev3dev_on_demand,
          [ on_demand/2,                % +Library, +Predicates
            on_demand_loaded/0,
            load_on_demand/0
          ]).

/** <module> Modules that are loaded when they are first used

Loading takes a brick long, and most programs use few of the modules. So
library(ev3dev) defines the predicates of the others as stubs:

```
led(Light, Colour) :-
    ev3dev_on_demand:first_call(library(ev3dev/lights), ev3dev_lights,
                                led(Light, Colour)).
```

The first call loads the module. Its predicates then take the places of their
stubs, in whatever module has imported these: as if library(ev3dev) had
reexported it. So they do if a program loads the module itself, by
on_demand_loaded/0 at the end of its file. Of several threads that call at
once, one loads, and the others wait until SWI-Prolog lets them have it.

While a predicate changes places, another thread that calls it finds none. So
stubs stay, and go on calling the module, until one is called while no other
thread runs. (SWI-Prolog's autoload/2 does the like of all this; but version
7.2.3 has none, and 9.0.4 none for exports.)
*/

:- dynamic
    stubs/3,                            % Module, Predicates, Importer
    loaded/1.                           % Module
:- thread_local
    is_called/0.                        % A call of a stub loads the module

:- module_transparent on_demand/2.

%!  on_demand(+Library, +Predicates) is det.
%
%   Define and export stubs of the Predicates of Library, a list of
%   Name/Arity, in the calling module. They are imported instead if Library is
%   loaded already.

on_demand(Library, Predicates) :-
    context_module(Importer),
    ev3dev_on_demand:define(Predicates, Library, Importer).

define(Predicates, Library, Importer) :-
    Library = library(ev3dev/Name),
    atom_concat(ev3dev_, Name, Module),
    (   module_property(Module, file(_))
    ->  Importer:reexport(Library)
    ;   % Else who calls Module:Predicate too early makes it import the stub.
        set_module(Module:base(system)),
        assertz(stubs(Module, Predicates, Importer)),
        define_stubs(Predicates, Module, Library, Importer)
    ).

define_stubs([], _, _, _).
define_stubs([Predicate|Predicates], Module, Library, Importer) :-
    define_stub(Predicate, Module, Library, Importer),
    define_stubs(Predicates, Module, Library, Importer).

define_stub(Name/Arity, Module, Library, Importer) :-
    functor(Head, Name, Arity),
    Call = ev3dev_on_demand:first_call(Library, Module, Head),
    assertz((Importer:Head :- Call)),
    export(Importer:Name/Arity).

first_call(Library, Module, Head) :-
    (   loaded(Module)
    ->  true
    ;   setup_call_cleanup(
            assertz(is_called),
            load(Library),
            retractall(is_called))
    ),
    (   is_alone
    ->  replace_stubs(Module)
    ;   true
    ),
    call(Module:Head).

load(Library) :-
    ev3dev_on_demand:use_module(Library, []).

% The thread that collects garbage calls none of them.
is_alone :-
    statistics(threads, Count),
    (   Count =:= 1
    ->  true
    ;   Count =:= 2,
        thread_property(_, alias(gc))
    ),
    !.

%!  on_demand_loaded is det.
%
%   Say at the end of a file that its predicates may be called. Unless a stub
%   does so already, they replace their stubs.

:- module_transparent on_demand_loaded/0.

on_demand_loaded :-
    context_module(Module),
    ev3dev_on_demand:is_loaded(Module).

is_loaded(Module) :-
    assertz(loaded(Module)),
    (   is_called
    ->  true
    ;   replace_stubs(Module)
    ).

replace_stubs(Module) :-
    forall(retract(stubs(Module, Predicates, Importer)),
           replace_each(Predicates, Module, Importer)).

replace_each([], _, _).
replace_each([Predicate|Predicates], Module, Importer) :-
    abolish(Importer:Predicate),
    Importer:import(Module:Predicate),
    replace_each(Predicates, Module, Importer).

%!  load_on_demand is det.
%
%   Load all that is not loaded yet, for who looks at everything.

load_on_demand :-
    forall(( stubs(Module, _, _), atom_concat(ev3dev_, Name, Module) ),
           load(library(ev3dev/Name))).
