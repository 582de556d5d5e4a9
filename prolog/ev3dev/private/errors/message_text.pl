:- module(ev3dev_message_text,
          [ message_text/2              % +Error, -Text
          ]).

/** <module> The text that Prolog would print for an error
*/

%!  message_text(+Error, -Text) is det.
%
%   Text is an atom.

message_text(Error, Text) :-
    '$messages':translate_message(Error, Lines, []),
    with_output_to(string(Printed),
                   print_message_lines(current_output, '', Lines)),
    split_string(Printed, "", " \n", [Trimmed]),
    atom_string(Text, Trimmed).
