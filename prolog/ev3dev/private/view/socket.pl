:- module(ev3dev_view_socket,
          [ accept_key/2,               % +Key, -Accept
            message_read/2,             % +In, -Message
            message_send/2,             % +Out, +Text
            ping_send/1,                % +Out
            close_send/2                % +Out, +Code
          ]).
:- use_module(library(base64), [base64//1]).
:- use_module(library(sha), [sha_hash/3]).

/** <module> The messages of a WebSocket

What RFC 6455 has between a browser and a server, on the streams of a
connection. SWI-Prolog's own library reads messages of any size into memory,
so this one reads them itself, up to 64 kB. Nothing is printed for a fault of
the other side.
*/

%   The most bytes that a message may have.
longest(65536).

%!  accept_key(+Key, -Accept) is det.
%
%   The answer to the key of a handshake (RFC 6455, 4.2.2).

accept_key(Key, Accept) :-
    atom_concat(Key, '258EAFA5-E914-47DA-95CA-C5AB0DC85B11', Text),
    sha_hash(Text, Hash, [algorithm(sha1)]),
    phrase(base64(Hash), Codes),
    atom_codes(Accept, Codes).

%!  message_read(+In, -Message) is det.
%
%   Read the next message: text(String), ping(Bytes), pong, close for the end
%   of the connection, or fault(Code), with the code that the other side is to
%   be told. In has octets.

message_read(In, Message) :-
    catch(frame_read(In, Frame), Fault, true),
    (   nonvar(Fault)
    ->  fault(Fault, Message)
    ;   Frame = frame(Final, OpCode, Bytes),
        message(OpCode, Final, Bytes, In, Message)
    ).

fault(fault(Code), Message) :-
    !,
    Message = fault(Code).
fault(Signal, _) :-
    signal(Signal),
    !,
    throw(Signal).
fault(_, close).

%   What others tell this thread.
signal(ev3dev_view(_)).
signal('$aborted').
signal(unwind(_)).

%   Messages in several frames (RFC 6455, 5.4) are no longer than others.
message(1, Final, Bytes, In, Message) :-
    !,
    more(Final, Bytes, In, All, Fault),
    (   nonvar(Fault)
    ->  Message = Fault
    ;   text(All, Text)
    ->  Message = text(Text)
    ;   Message = fault(1007)
    ).
message(8, 1, Bytes, _, Message) :-
    !,
    closing(Bytes, Message).
message(9, 1, Bytes, _, ping(Bytes)) :-
    !.
message(10, 1, _, _, pong) :-
    !.
message(2, _, _, _, fault(1003)) :-
    !.
message(_, _, _, _, fault(1002)).

more(1, Bytes, _, Bytes, _) :-
    !.
more(0, Bytes, In, All, Fault) :-
    catch(frame_read(In, frame(Final, OpCode, Next)), Fault0, true),
    (   nonvar(Fault0)
    ->  fault(Fault0, Fault)
    ;   OpCode =:= 0
    ->  append_bytes(Bytes, Next, Both),
        length(Both, Length),
        (   longest(Longest),
            Length > Longest
        ->  Fault = fault(1009)
        ;   more(Final, Both, In, All, Fault)
        )
    ;   memberchk(OpCode, [9, 10])
    ->  more(0, Bytes, In, All, Fault)
    ;   OpCode =:= 8
    ->  closing(Next, Fault)
    ;   Fault = fault(1002)
    ).

%   What a page closes with: nothing, or a code that may be sent, and a reason
%   (RFC 6455, 5.5.1 and 7.4).
closing([], close).
closing([_], fault(1002)).
closing([High, Low|Reason], Message) :-
    Code is High << 8 \/ Low,
    (   \+ may_be_sent(Code)
    ->  Message = fault(1002)
    ;   text(Reason, _)
    ->  Message = close
    ;   Message = fault(1007)
    ).

may_be_sent(Code) :-
    between(1000, 4999, Code),
    \+ between(1004, 1006, Code),
    \+ between(1015, 2999, Code).

append_bytes([], Bytes, Bytes).
append_bytes([Byte|Bytes0], Bytes1, [Byte|Bytes]) :-
    append_bytes(Bytes0, Bytes1, Bytes).

%   A frame: two bytes, perhaps a longer length, the mask, the data (RFC 6455,
%   5.2). What a browser sends is masked.
frame_read(In, frame(Final, OpCode, Bytes)) :-
    byte(In, First),
    byte(In, Second),
    Final is First >> 7,
    OpCode is First /\ 15,
    (   First /\ 0x70 =:= 0,
        Second >= 128,
        memberchk(OpCode, [0, 1, 2, 8, 9, 10])
    ->  true
    ;   throw(fault(1002))
    ),
    Short is Second /\ 127,
    (   OpCode >= 8,
        ( Final =:= 0 ; Short > 125 )
    ->  throw(fault(1002))
    ;   true
    ),
    payload_length(Short, In, Length),
    longest(Longest),
    (   Length > Longest
    ->  throw(fault(1009))
    ;   true
    ),
    byte(In, M0),
    byte(In, M1),
    byte(In, M2),
    byte(In, M3),
    masked(Length, In, M0, M1, M2, M3, Bytes).

payload_length(126, In, Length) :-
    !,
    number_read(2, In, 0, Length).
payload_length(127, In, Length) :-
    !,
    number_read(8, In, 0, Length).
payload_length(Length, _, Length).

number_read(0, _, Number, Number) :-
    !.
number_read(Count, In, Number0, Number) :-
    byte(In, Byte),
    Number1 is Number0 << 8 \/ Byte,
    Count1 is Count - 1,
    number_read(Count1, In, Number1, Number).

masked(0, _, _, _, _, _, Bytes) :-
    !,
    Bytes = [].
masked(Length, In, M0, M1, M2, M3, [Byte|Bytes]) :-
    byte(In, Masked),
    Byte is Masked xor M0,
    Left is Length - 1,
    masked(Left, In, M1, M2, M3, M0, Bytes).

byte(In, Byte) :-
    get_code(In, Byte),
    (   Byte >= 0
    ->  true
    ;   throw(end)
    ).

%   Bytes as a text in UTF-8; fails if they are not (RFC 3629).
text(Bytes, Text) :-
    phrase(letters(Codes), Bytes),
    string_codes(Text, Codes).

letters([Code|Codes]) -->
    [Byte],
    !,
    letter(Byte, Code),
    letters(Codes).
letters([]) -->
    [].

letter(Byte, Code) -->
    { Byte < 0x80 },
    !,
    { Code = Byte }.
letter(Byte, Code) -->
    { Byte >= 0xc2, Byte < 0xe0 },
    !,
    tail(B1),
    { Code is (Byte /\ 0x1f) << 6 \/ B1 }.
letter(Byte, Code) -->
    { Byte >= 0xe0, Byte < 0xf0 },
    !,
    tail(B1),
    tail(B2),
    { Code is (Byte /\ 0x0f) << 12 \/ B1 << 6 \/ B2,
      Code >= 0x800,
      \+ between(0xd800, 0xdfff, Code)
    }.
letter(Byte, Code) -->
    { Byte >= 0xf0, Byte < 0xf5 },
    tail(B1),
    tail(B2),
    tail(B3),
    { Code is (Byte /\ 7) << 18 \/ B1 << 12 \/ B2 << 6 \/ B3,
      Code >= 0x10000,
      Code =< 0x10ffff
    }.

tail(Bits) -->
    [Byte],
    { Byte /\ 0xc0 =:= 0x80,
      Bits is Byte /\ 0x3f
    }.

%!  message_send(+Out, +Text) is det.
%
%   Send a text, all of whose letters are ASCII. One call of format/3 writes
%   all of it, and no other thread in between.

message_send(Out, Text) :-
    string_length(Text, Length),
    (   Length < 126
    ->  Head = [Length]
    ;   Length < 65536
    ->  Head = [126|Bytes],
        bytes(2, Length, Bytes)
    ;   Head = [127|Bytes],
        bytes(8, Length, Bytes)
    ),
    format(Out, "~s~w", [[0x81|Head], Text]),
    flush_output(Out).

bytes(0, _, []) :-
    !.
bytes(Count, Number, [Byte|Bytes]) :-
    Left is Count - 1,
    Byte is Number >> (8 * Left) /\ 255,
    bytes(Left, Number, Bytes).

%!  ping_send(+Out) is det.

ping_send(Out) :-
    format(Out, "~s", [[0x89, 0]]),
    flush_output(Out).

%!  close_send(+Out, +Code) is det.

close_send(Out, Code) :-
    bytes(2, Code, Bytes),
    format(Out, "~s", [[0x88, 2|Bytes]]),
    flush_output(Out).
