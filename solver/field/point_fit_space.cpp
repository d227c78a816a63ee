#include "solver/field/point_fit.h"

namespace supple {

template void evaluate_at<3, 0>(const MovingLeastSquares<3>&, const VectorOf<3>&,
                                ShapeFunctions<3>&);
template void evaluate_at<3, 1>(const MovingLeastSquares<3>&, const VectorOf<3>&,
                                ShapeFunctions<3>&);
template void fit_at<3>(const MovingLeastSquares<3>&, const VectorOf<3>&, ShapeFunctions<3>&);

}  // namespace supple
