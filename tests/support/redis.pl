:- module(redis_server,
          [ can_use_redis/0,
            with_redis_server/2,        % -Port, :Goal
            start_redis/2,              % +Port, -Process
            stop_redis/1                % +Process
          ]).
:- use_module(library(process)).
:- use_module(library(random)).
:- use_module(library(socket)).

/** <module> A Redis server of one test, on a port of the loopback device
*/

:- meta_predicate with_redis_server(-, 0).

%!  can_use_redis
%
%   True if this machine has redis-server, and this Prolog a library for it.

can_use_redis :-
    absolute_file_name(path('redis-server'), _, [access(execute), file_errors(fail)]),
    exists_source(library(redis)).

%!  with_redis_server(-Port, :Goal)
%
%   Call Goal once while an empty server listens at Port.

with_redis_server(Port, Goal) :-
    between(1, 20, _),
    random_between(20000, 32000, Port),
    \+ answers(Port),
    start_redis(Port, Server),
    !,
    call_cleanup(once(Goal), stop_redis(Server)).

%!  start_redis(+Port, -Process) is semidet.
%
%   Fails if it does not answer, as where the port is taken.

start_redis(Port, Server) :-
    process_create(path('redis-server'),
                   ['--port', Port, '--bind', '127.0.0.1', '--save', '', '--appendonly', no],
                   [stdin(null), stdout(null), stderr(null), process(Server)]),
    (   between(1, 200, _),
        ( answers(Port) -> true ; sleep(0.05), fail )
    ->  true
    ;   stop_redis(Server),
        fail
    ).

answers(Port) :-
    catch(setup_call_cleanup(tcp_connect(localhost:Port, Stream, []), true, close(Stream)),
          error(_, _), fail).

%!  stop_redis(+Process)

stop_redis(Server) :-
    catch(process_kill(Server, kill), error(_, _), true),
    catch(process_wait(Server, _), error(_, _), true).
