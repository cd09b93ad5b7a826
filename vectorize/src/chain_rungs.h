#pragma once

#include "boundary_graph.h"
#include "premultiplied_colours.h"

namespace quadrille {

/// Leaves out the graph's rungs and joins what they parted. Along a thin oblique strip, such as the
/// stroke of a drawing, the gradient's valley is a row of pits, and the lines between these lead
/// across the strip like the rungs of a ladder: short, lowest in their middle, and with the same
/// colour on both sides there, to less than `contrast`. `gradient` is the norm of the gradient per
/// cell, `cell` the size of the cells in source pixels.
void leave_out_rungs(BoundaryGraph& graph, const PremultipliedColours& colours,
                     const FieldGrid<float>& gradient, double cell, double contrast);

}  // namespace quadrille
