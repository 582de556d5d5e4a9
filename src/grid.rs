//! `prolog/ev3dev/private/grid/map.pl`: maps of cells that are drawn.
use crate::facts::drawing;
use crate::glue::call::Call;
use crate::glue::terms::Prolog;
use swipl::prelude::*;

natives! {
    /// grid_drawn_(+Rows, -Drawn): drawn(Width, Height, Obstructed, Start), where start is
    /// start(Cell, Heading) or `none`, and a cell is `[X, Y]`.
    semidet fn "grid_drawn_"(context, rows, drawn) as call("grid_map", 2) {
        let (_, drawing) = drawing(&call, rows)?;
        let cells = drawing.obstructed().map(|cell| cell_term(&call, cell));
        let obstructed = context.new_term_ref();
        obstructed.unify(cells.collect::<PrologResult<Vec<_>>>()?.as_slice())?;
        let start = match drawing.start() {
            None => term! {context: none}?,
            Some((cell, heading)) => {
                let (cell, heading) = (cell_term(&call, cell)?, u64::from(heading));
                term! {context: start(#&cell, #heading)}?
            }
        };
        let [width, height] = drawing.size().map(|count| count as u64);
        drawn.unify(&term! {context: drawn(#width, #height, #&obstructed, #&start)}?)
    }
}

fn cell_term<'a, C: Prolog>(call: &Call<'a, C>, at: [usize; 2]) -> PrologResult<Term<'a>> {
    let term = call.context.new_term_ref();
    term.unify(at.map(|count| count as u64).as_slice())?;
    Ok(term)
}
