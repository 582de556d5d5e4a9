:- module(cheats,
          [ cheat/2,                    % ?Name, ?Lines
            honest/1                    % -Lines
          ]).

/** <module> Programs that want points that they have not earned, and broken ones

For the exercise of tests/prolog/test_exercise.pl: drive 100 cm, and touch nothing. What they
print, write or kill must not make a mark, nor lose one.
*/

honest([ ":- use_module(library(ev3dev)).",
         "start :- set_robot(5.6, 10.6, outB, outC), go_cm(60, 110)." ]).

%!  cheat(?Name, ?Lines) is nondet.
%
%   The lines of a program, without those that load library(ev3dev). The first ten are those
%   that `make check` tries.

cheat(says_its_marks,       ["start :- writeln('Together: 10 of 10 points'), nl."]).
cheat(speaks_as_a_run,      ["start :- writeln('score(result(over,5.0,[1,1],\\'\\',\\'\\',[],[],[]))').",
                             ":- writeln('over(exited(0))')."]).
cheat(halts_at_once,        [":- halt."]).
cheat(does_not_end,         ["start :- repeat, fail."]).
cheat(catches_all,          ["start :- repeat, catch((repeat, fail), _, true), fail."]).
cheat(kills_its_marker,     ["start :- shell('kill -9 $(ps -o ppid= -p $PPID)'), wait(1)."]).
cheat(places_itself,        [":- use_module(library(ev3dev/sim)).",
                             "start :- sim_place(150, 150, 0), wait(1)."]).
cheat(starts_its_own_world, [":- use_module(library(ev3dev/sim)).",
                             "start :- sim_start([start(0, 0, 0)], [clock(virtual)]),",
                             "    set_robot(5.6, 10.6, outB, outC), go_cm(60, 110)."]).
cheat(does_not_parse,       ["start :- a b."]).
cheat(prints_without_end,   ["start :- repeat, format('~`xt~1000|~n'), fail."]).
cheat(leaves_a_process,     ["start :- shell('setsid sleep 1000 >/dev/null 2>&1 &')."]).
cheat(leaves_many,          ["start :- forall(between(1, 100, _), catch(shell('sleep 1000 &'), _, true))."]).
cheat(forks_without_end,    ["start :- shell(':(){ :|:& };:')."]).
cheat(eats_memory,          ["start :- numlist(1, 100000000, L), atom_codes(_, L)."]).
cheat(eats_memory_by_atoms, ["start :- between(1, inf, N), atom_concat(an_atom_that_stays_, N, A), assertz(kept(A)), fail.",
                             ":- dynamic kept/1."]).
cheat(eats_the_stack,       ["start :- deep(0).", "deep(N) :- M is N+1, deep(M), true."]).
cheat(waits_by_sleep,       ["start :- sleep(1000)."]).
cheat(waits_for_a_message,  ["start :- thread_get_message(never)."]).
cheat(reads_the_keyboard,   ["start :- read(X), writeln(X)."]).
cheat(kills_itself,         ["start :- shell('kill -9 $PPID')."]).
cheat(crashes,              ["start :- shell('kill -SEGV $PPID')."]).
cheat(throws_odd_things,    ["start :- throw(f(_, 'a\nb', \"c\"))."]).
cheat(aborts,               ["start :- abort."]).
cheat(is_empty,             []).
cheat(is_no_text,           ["\x01\\x02\\xff\ start :- true."]).
cheat(asks_for_the_world,   [":- use_module(library(ev3dev/sim)).",
                             "start :- sim_svg('world.svg')."]).
cheat(undoes_collisions,    [":- use_module(library(ev3dev/sim)).",
                             "start :- sim_snapshot(S), sim_restore(S)."]).
cheat(reads_the_exercise,   ["start :- expand_file_name('/tmp/*exercise*', L), print(L),",
                             "    forall(member(F, L), catch(delete_file(F), _, true))."]).
cheat(writes_marks,         ["start :- forall(member(D, ['.', '..']),",
                             "    catch(( atom_concat(D, '/marks.csv', F), open(F, write, O),",
                             "            writeln(O, me), close(O) ), _, true))."]).
cheat(links_its_reports,    ["start :- catch(shell('[ -S robot ] && for f in *; do ln -sf /proc/version $f; done'), _, true)."]).
cheat(makes_a_pipe,         ["start :- catch(shell('rm -f told; mkfifo told'), _, true)."]).
cheat(tells_lies,           ["start :- catch(( open(told, write, O), format(O, '1.0\trule <script>alert(1)</script>~n', []), close(O) ), _, true)."]).
cheat(exits_with_a_status,  ["start :- halt(137)."]).
cheat(redefines_waiting,    [":- redefine_system_predicate(halt).", "halt.", "start :- true."]).
cheat(stops_the_clock,      [":- use_module(library(socket)).",
                             "start :- forall(between(1, 100, _), catch(wait(-1), _, true))."]).
cheat(unloads_the_pack,     ["start :- unload_file(library(ev3dev)), halt."]).
cheat(uses_the_wire,        ["start :- catch(ev3dev_native:sim_fence_serve_(0, 1, X), E, (print(E), nl)), print(X)."]).
cheat(opens_a_fence,        ["start :- catch(ev3dev_native:sim_fence_open_('/tmp/x'), E, (print(E), nl))."]).
cheat(changes_its_limits,   ["start :- shell('ulimit -t unlimited; ulimit -f unlimited; while :; do :; done')."]).
cheat(stops_itself,         ["start :- shell('kill -STOP $PPID')."]).
