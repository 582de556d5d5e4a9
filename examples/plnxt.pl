% Put this file beside a program that begins with :- consult('plnxt.pl').
:- use_module(library(ev3dev/plnxt)).
