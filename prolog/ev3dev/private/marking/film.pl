:- module(ev3dev_marking_film,
          [ film/3                      % +Exercise, +Seed, +Result
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(records, []).
:- use_module('../../sim', [with_sim/3]).
:- use_module('../../sim_views', [sim_svg/1, sim_things/1]).
:- use_module(read, [exercise_setting/3, exercise_world/3]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> A run as a picture with a slider

The simulator draws the world. This module adds the way of the robot in ten
parts that grow darker, the places where it ran into something, the ways of
things that were moved, and the robot and the things, which a slider moves.
*/

%!  film(+Exercise, +Seed, +Result) is det.
%
%   Print HTML. Result is as of marked_run/5.

film(Exercise, Seed, Result) :-
    Result = result(seconds: Seconds, film: Film, ways: Ways,
                    collisions: Collisions),
    world_picture(Exercise, Seed, Head, Robot, Names),
    write(Head),
    forall(( member(_-Way, Ways), Way = [_, _|_] ), thing_way(Way)),
    way(Film, Seconds),
    forall(member(collision(Time, X, Y, _), Collisions),
           format("<circle cx=\"~2f\" cy=\"~2f\" r=\"3\" fill=\"#d00\">\c
                   <title>ran into something at ~1f s</title></circle>~n",
                  [X, Y, Time])),
    write(Robot),
    length(Film, Count),
    Last is Count-1,
    format("<p><label>Time: <output id=\"time\">0.0</output> s\c
            <input id=\"moment\" type=\"range\" min=\"0\" max=\"~d\" \c
            value=\"0\"></label> <button id=\"play\">Play</button></p>~n\c
            <p>The way is light at the beginning and dark at the end. Red \c
            points: where it ran into something.</p>~n<script>~n\c
            const film = [", [Last]),
    forall(member(Pose, Film), numbers(Pose)),
    format("]~nconst ways = [", []),
    forall(member(Name, Names),
           ( ( memberchk(Name-Way, Ways) -> true ; Way = [] ),
             format("[", []),
             forall(member(Place, Way), numbers(Place)),
             format("],", []) )),
    format("]~nconst seconds = ~3f~n", [Seconds]),
    script.

%   Up to its robot, and from there on. The path there is that of no run.
%   Names are those of its things, in their order in the picture.

world_picture(Exercise, Seed, Head, Robot, Names) :-
    exercise_world(Exercise, Seed, World),
    exercise_setting(Exercise, robot(Shape), default),
    tmp_file(ev3dev_picture, File),
    setup_call_cleanup(
        true,
        ( with_sim(World, ( sim_svg(File), sim_things(Things) ),
                   [clock(virtual), robot(Shape)]),
          read_file_to_string(File, Svg, [encoding(utf8)]) ),
        catch(delete_file(File), error(_, _), true)),
    sub_string(Svg, Before, _, _, "<polyline class=\"path\""),
    sub_string(Svg, Begin, _, _, "<g class=\"robot\""),
    Begin > Before,
    !,
    sub_string(Svg, 0, Before, _, Head),
    sub_string(Svg, Begin, _, 0, Robot),
    findall(Name, member(thing(Name, _, _, _), Things), Names).

thing_way(Way) :-
    format("<polyline points=\"", []),
    forall(member([_, X, Y, _], Way), point(X, Y)),
    format("\" fill=\"none\" stroke=\"#888\" stroke-width=\"0.6\" \c
            stroke-dasharray=\"2 1.5\"/>~n", []).

point(X, Y) :-
    CmX is X/10,
    CmY is Y/10,
    format("~1f,~1f ", [CmX, CmY]).

way(Film, Seconds) :-
    length(Film, Count),
    Size is max(1, ceiling(Count/10)),
    way(Film, Size, 0, Seconds).

way([], _, _, _).
way([Pose|Film], Size, N, Seconds) :-
    taken(Size, [Pose|Film], Part0, Rest),
    (   Rest = [Next|_]
    ->  append(Part0, [Next], Part)
    ;   Part = Part0
    ),
    Light is 75-6*N,
    format("<polyline points=\"", []),
    forall(member([X, Y, _], Part), point(X, Y)),
    From is N*Seconds/10,
    format("\" fill=\"none\" stroke=\"hsl(220 80% ~d%)\" stroke-width=\"1\">\c
            <title>from ~1f s</title></polyline>~n", [Light, From]),
    Next1 is N+1,
    way(Rest, Size, Next1, Seconds).

taken(0, Rest, [], Rest) :-
    !.
taken(_, [], [], []) :-
    !.
taken(Count, [Pose|Film], [Pose|Part], Rest) :-
    Left is Count-1,
    taken(Left, Film, Part, Rest).

numbers(Numbers) :-
    atomic_list_concat(Numbers, ',', Text),
    format("[~w],", [Text]).

script :-
    format("const robot = document.querySelector('g.robot')~n\c
const things = document.querySelectorAll('svg .thing')~n\c
const slider = document.getElementById('moment')~n\c
function place (shape, [x, y, heading]) {~n\c
  shape.setAttribute('transform',~n\c
    `translate(${x / 10},${y / 10}) rotate(${-heading})`)~n\c
}~n\c
function show () {~n\c
  place(robot, film[slider.value])~n\c
  ways.forEach((way, index) => {~n\c
    const there = way.filter(([moment]) => moment <= slider.value).pop()~n\c
    if (there) place(things[index], there.slice(1))~n\c
  })~n\c
  document.getElementById('time').textContent =~n\c
    (seconds * slider.value / Math.max(1, film.length - 1)).toFixed(1)~n\c
}~n\c
slider.addEventListener('input', show)~n\c
let timer = 0~n\c
document.getElementById('play').addEventListener('click', event => {~n\c
  clearInterval(timer)~n\c
  if (event.target.textContent === 'Stop') {~n\c
    event.target.textContent = 'Play'~n\c
    return~n\c
  }~n\c
  event.target.textContent = 'Stop'~n\c
  if (+slider.value === film.length - 1) slider.value = 0~n\c
  timer = setInterval(() => {~n\c
    slider.value = +slider.value + 1~n\c
    show()~n\c
    if (+slider.value === film.length - 1) {~n\c
      clearInterval(timer)~n\c
      event.target.textContent = 'Play'~n\c
    }~n\c
  }, 100)~n\c
})~n\c
show()~n\c
</script>~n", []).
