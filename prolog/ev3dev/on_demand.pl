:- module(ev3dev_on_demand,
          [ on_demand/2,                % +Library, +Predicates
            on_demand_loaded/0,
            load_on_demand/0
          ]).
:- use_module(library(lists), [member/2]).

/** <module> Modules that are loaded when they are first used

Loading takes a brick long, and most programs use few of the modules. So
library(ev3dev) defines the predicates of the others as stubs:

```
led(Light, Colour) :-
    ev3dev_on_demand:first_call(library(ev3dev/lights), ev3dev_lights,
                                led(Light, Colour)).
```

The first call loads the module. At the end of its file, which says
on_demand_loaded/0, its predicates take the places of their stubs, in whatever
module has imported these. From then on it is as if library(ev3dev) had
reexported the module. Of several threads that call at once, one loads, and
the others wait until SWI-Prolog lets them have the module. (Its autoload/2
does the like; but version 7.2.3 has none, and 9.0.4 none for exports.)
*/

:- dynamic
    stubs/3,                            % Module, Predicates, Importer
    replaced/2.                         % Predicates, Importer

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
        forall(member(Predicate, Predicates),
               define_stub(Predicate, Module, Library, Importer))
    ).

define_stub(Name/Arity, Module, Library, Importer) :-
    functor(Head, Name, Arity),
    Call = ev3dev_on_demand:first_call(Library, Module, Head),
    assertz((Importer:Head :- Call)),
    export(Importer:Name/Arity).

first_call(Library, Module, Head) :-
    load(Library),
    call(Module:Head).

load(Library) :-
    ev3dev_on_demand:use_module(Library, []).

%!  on_demand_loaded is det.
%
%   Say at the end of a file that its predicates may be called: they replace
%   their stubs.

:- module_transparent on_demand_loaded/0.

on_demand_loaded :-
    context_module(Module),
    ev3dev_on_demand:replace_stubs(Module).

replace_stubs(Module) :-
    with_mutex(ev3dev_on_demand,
               forall(retract(stubs(Module, Predicates, Importer)),
                      replace_stubs(Predicates, Module, Importer))).

replace_stubs(Predicates, Module, Importer) :-
    assertz(replaced(Predicates, Importer)),
    forall(member(Predicate, Predicates),
           ( abolish(Importer:Predicate),
             Importer:import(Module:Predicate)
           )).

% Another thread may call between these two: it waits until both are done.
:- multifile user:exception/3.
:- dynamic user:exception/3.

user:exception(undefined_predicate, Importer:Predicate, retry) :-
    ev3dev_on_demand:replaced(Predicates, Importer),
    memberchk(Predicate, Predicates),
    !,
    with_mutex(ev3dev_on_demand, true).

%!  load_on_demand is det.
%
%   Load all that is not loaded yet, for who looks at everything.

load_on_demand :-
    findall(Module, stubs(Module, _, _), Modules),
    forall(( member(Module, Modules), atom_concat(ev3dev_, Name, Module) ),
           load(library(ev3dev/Name))).
