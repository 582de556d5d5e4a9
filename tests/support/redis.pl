:- module(redis_server,
          [ can_use_redis/0,
            with_redis_server/2,        % -Port, :Goal
            with_server_again/2,        % +Port, :Goal
            with_client/3               % +Port, -Redis, :Goal
          ]).
:- use_module(trees, [eventually/1]).
:- use_module(library(process)).
:- use_module(library(random)).
:- use_module(library(socket)).

/** <module> A Redis server of one test, on a port of the loopback device
*/

:- meta_predicate
    with_redis_server(-, 0),
    with_server_again(+, 0),
    with_client(+, -, 0).

:- ( exists_source(library(redis)) -> use_module(library(redis)) ; true ).

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

stop_redis(Server) :-
    catch(process_kill(Server, kill), error(_, _), true),
    catch(process_wait(Server, _), error(_, _), true).

%!  with_client(+Port, -Redis, :Goal)

with_client(Port, Redis, Goal) :-
    setup_call_cleanup(redis_connect(localhost:Port, Redis, []), once(Goal),
                       redis_disconnect(Redis)).

%!  with_server_again(+Port, :Goal)
%
%   The server at this port ends, and begins again empty.

with_server_again(Port, Goal) :-
    catch(with_client(Port, Redis, redis(Redis, shutdown(nosave))), error(_, _), true),
    setup_call_cleanup(eventually(start_redis(Port, Server)), once(Goal), stop_redis(Server)).
