:- module(ev3dev_breadth_first,
          [ breadth_first/5,            % +Space, +Start, +Goals, -Path,
                                        % -Expanded
            two_breadth_first/5         % +Space, +Start, +Goals, -Path,
                                        % -Expanded
          ]).
:- use_module(library(assoc), [get_assoc/3, list_to_assoc/2, put_assoc/4]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(library(pairs), [pairs_keys_values/3]).
:- use_module(space).

/** <module> Breadth-first search, from one side and from both

Level by level: first all states that one step leads to, then those that are
two steps away, and so on. Costs do not matter.
*/

%!  breadth_first(+Space, +Start, +Goals, -Path, -Expanded) is det.
%!  two_breadth_first(+Space, +Start, +Goals, -Path, -Expanded) is det.
%
%   True if Path is the list of `step(Action, Cost)` that lead from Start to
%   one of Goals, or `none`. Expanded is the number of expanded states.
%   breadth_first/5 expands from Start, two_breadth_first/5 from both ends,
%   always at the end whose outermost level has fewer states.
%
%   The first state that both sides reach lies on a shortest path. A shorter
%   path would have a state on the outermost finished level of one side, which
%   the other side had reached before.

breadth_first(_, Start, Goals, [], 0) :-
    memberchk(Start, Goals),
    !.
breadth_first(Space, Start, Goals, Path, Expanded) :-
    list_to_assoc([Start-start], Reached),
    levels([Start], Reached, 0, Space, Goals, Path, Expanded).

levels([], _, Expanded, _, _, none, Expanded) :-
    !.
levels(Level, Reached0, Expanded0, Space, Goals, Path, Expanded) :-
    level(Level, ahead(Space), in(Goals), Met, [], Reversed,
          Reached0, Reached, Expanded0, Expanded1),
    (   Met = met(State)
    ->  way(State, Reached, [], Path),
        Expanded = Expanded1
    ;   reverse(Reversed, Next),
        levels(Next, Reached, Expanded1, Space, Goals, Path, Expanded)
    ).

two_breadth_first(_, Start, Goals, [], 0) :-
    memberchk(Start, Goals),
    !.
two_breadth_first(Space, Start, Goals, Path, Expanded) :-
    needs_way_back(Space),
    list_to_assoc([Start-start], Reached),
    findall(Goal-start, member(Goal, Goals), Pairs0),
    sort(Pairs0, Pairs),
    pairs_keys_values(Pairs, Level, _),
    list_to_assoc(Pairs, ReachedBack),
    sides(side(ahead(Space), [Start], 1, Reached),
          side(back(Space), Level, 1, ReachedBack), 0, Path, Expanded).

sides(side(_, [], _, _), _, Expanded, none, Expanded) :-
    !.
sides(_, side(_, [], _, _), Expanded, none, Expanded) :-
    !.
sides(SideA, SideB, Expanded0, Path, Expanded) :-
    SideA = side(_, _, SizeA, _),
    SideB = side(_, _, SizeB, _),
    (   SizeA =< SizeB
    ->  side(SideA, SideB, Expanded0, Path, Expanded)
    ;   side(SideB, SideA, Expanded0, Path, Expanded)
    ).

side(side(Direction, Level, _, Reached0), Other, Expanded0, Path, Expanded) :-
    Other = side(_, _, _, ReachedOther),
    level(Level, Direction, among(ReachedOther), Met, [], Reversed,
          Reached0, Reached, Expanded0, Expanded1),
    (   Met = met(State)
    ->  joined(Direction, State, Reached, ReachedOther, Path),
        Expanded = Expanded1
    ;   reverse(Reversed, Next),
        length(Next, Size),
        sides(side(Direction, Next, Size, Reached), Other, Expanded1,
              Path, Expanded)
    ).

joined(ahead(_), State, Reached, ReachedBack, Path) :-
    way(State, Reached, [], Ahead),
    way(State, ReachedBack, [], Back),
    reverse(Back, Rest),
    append(Ahead, Rest, Path).
joined(back(Space), State, ReachedBack, Reached, Path) :-
    joined(ahead(Space), State, Reached, ReachedBack, Path).

%   Expand the states of a level until a Wanted state is Met.

level([], _, _, none, Next, Next, Reached, Reached, Expanded, Expanded).
level([State|Level], Direction, Wanted, Met, Next0, Next, Reached0, Reached,
      Expanded0, Expanded) :-
    Expanded1 is Expanded0 + 1,
    expand(Direction, State, Ways),
    reach(Ways, State, Wanted, Met1, Next0, Next1, Reached0, Reached1),
    (   Met1 = met(_)
    ->  Met = Met1,
        Next = Next1,
        Reached = Reached1,
        Expanded = Expanded1
    ;   level(Level, Direction, Wanted, Met, Next1, Next, Reached1, Reached,
              Expanded1, Expanded)
    ).

expand(ahead(Space), State, Ways) :-
    space_next(Space, State, Ways).
expand(back(Space), State, Ways) :-
    space_previous(Space, State, Ways).

reach([], _, _, none, Next, Next, Reached, Reached).
reach([way(Action, State, Cost)|Ways], From, Wanted, Met,
      Next0, Next, Reached0, Reached) :-
    (   get_assoc(State, Reached0, _)
    ->  reach(Ways, From, Wanted, Met, Next0, Next, Reached0, Reached)
    ;   put_assoc(State, Reached0, from(From, Action, Cost), Reached1),
        (   wanted(Wanted, State)
        ->  Met = met(State),
            Next = Next0,
            Reached = Reached1
        ;   reach(Ways, From, Wanted, Met, [State|Next0], Next,
                  Reached1, Reached)
        )
    ).

wanted(in(Goals), State) :-
    memberchk(State, Goals).
wanted(among(Reached), State) :-
    get_assoc(State, Reached, _).

way(State, Reached, Path0, Path) :-
    get_assoc(State, Reached, From),
    (   From = from(Before, Action, Cost)
    ->  way(Before, Reached, [step(Action, Cost)|Path0], Path)
    ;   Path = Path0
    ).
