:- module(ev3dev_redis,
          [ redis_address/2,            % +Address, -HostPort
            with_redis/3,               % +HostPort, -Redis, :Goal
            connected/2,                % +HostPort, -Redis
            disconnected/1,             % +Redis
            ask/3,                      % +Redis, +Command, -Answer
            connection_lost/1           % @Error
          ]).
:- use_module('../errors/errors', [throw_error/3]).

:- meta_predicate with_redis(+, -, 0).

/** <module> A Redis server, by library(redis)
*/

%!  redis_address(+Address, -HostPort) is det.
%
%   Address is Host or Host:Port, also as one atom.
%
%   @error domain_error(redis_address, Address)

redis_address(Address, HostPort) :-
    (   Address = Host:Port,
        atom(Host),
        integer(Port)
    ->  HostPort = Host:Port
    ;   atom(Address)
    ->  (   atomic_list_concat([Host, Text], :, Address),
            atom_number(Text, Port)
        ->  HostPort = Host:Port
        ;   HostPort = Address:6379
        )
    ;   throw_error(domain_error(redis_address, Address), _,
                    'an address is Host or Host:Port')
    ).

%!  with_redis(+HostPort, -Redis, :Goal) is semidet.
%
%   Call Goal once with a connection of its own.
%
%   @error existence_error(redis_server, HostPort)
%   @error existence_error(library, redis)

with_redis(Address, Redis, Goal) :-
    setup_call_cleanup(
        connected(Address, Redis),
        once(Goal),
        disconnected(Redis)).

%!  connected(+HostPort, -Redis) is det.
%!  disconnected(+Redis) is det.
%
%   library(redis) would try for a day to reach a server that is not there.

connected(Address, Redis) :-
    redis_loaded,
    catch(of_redis(redis_connect(Address, Redis, [reconnect(false)])),
          error(_, _),
          ( format(atom(Text), 'no Redis server answers at ~w', [Address]),
            throw_error(existence_error(redis_server, Address), _, Text) )).

disconnected(Redis) :-
    catch(of_redis(redis_disconnect(Redis, [force(true)])), error(_, _),
          true).

redis_loaded :-
    Library = redis,
    (   catch(use_module(library(Library), []), error(_, _), fail)
    ->  true
    ;   throw_error(existence_error(library, redis), _,
                    'this Prolog comes without library(redis)')
    ).

%!  ask(+Redis, +Command, -Answer) is semidet.
%
%   Fails if there is no answer: Redis says nil.

ask(Redis, Command, Answer) :-
    of_redis(redis(Redis, Command, Answer)).

%   7.2.3 has no such library.

of_redis(Goal) :-
    call(redis:Goal).

%!  connection_lost(@Error) is semidet.
%
%   True if Error is that of a connection that is no more, or of a server that
%   is not there, or reads what it had.

connection_lost(Error) :-
    nonvar(Error),
    Error = error(Formal, _),
    (   Formal = io_error(_, _)
    ;   Formal = socket_error(_, _)
    ;   Formal = syntax_error(unexpected_eof)
    ;   Formal = existence_error(redis_server, _)
    ;   Formal = redis_error(loading, _)
    ),
    !.
