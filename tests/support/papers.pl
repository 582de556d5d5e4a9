:- module(papers,
          [ code_blocks/2               % +File, -Blocks
          ]).
:- use_module(library(readutil)).

/** <module> What stands in the documents
*/

%!  code_blocks(+File, -Blocks)
%
%   Blocks are the blocks of code in a Markdown File, as block(Language,
%   Lines); Language is "" if none is named.

code_blocks(File, Blocks) :-
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    phrase(blocks(Blocks), Lines).

blocks([block(Language, Lines)|Blocks]) -->
    [Fence],
    { string_concat("```", Language, Fence) },
    !,
    block(Lines),
    blocks(Blocks).
blocks(Blocks) -->
    [_],
    !,
    blocks(Blocks).
blocks([]) -->
    [].

block([]) -->
    ["```"],
    !.
block([Line|Lines]) -->
    [Line],
    block(Lines).
