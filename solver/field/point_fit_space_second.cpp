#include "solver/field/point_fit.h"

namespace supple {

template void evaluate_at<3, 2>(const MovingLeastSquares<3>&, const VectorOf<3>&,
                                ShapeFunctions<3>&);

}  // namespace supple
