#include "solver/field/point_fit.h"

namespace supple {

template void evaluate_at<1, 0>(const MovingLeastSquares<1>&, const VectorOf<1>&,
                                ShapeFunctions<1>&);
template void evaluate_at<1, 1>(const MovingLeastSquares<1>&, const VectorOf<1>&,
                                ShapeFunctions<1>&);
template void evaluate_at<1, 2>(const MovingLeastSquares<1>&, const VectorOf<1>&,
                                ShapeFunctions<1>&);
template void fit_at<1>(const MovingLeastSquares<1>&, const VectorOf<1>&, ShapeFunctions<1>&);
template void evaluate_at<2, 0>(const MovingLeastSquares<2>&, const VectorOf<2>&,
                                ShapeFunctions<2>&);
template void evaluate_at<2, 1>(const MovingLeastSquares<2>&, const VectorOf<2>&,
                                ShapeFunctions<2>&);
template void evaluate_at<2, 2>(const MovingLeastSquares<2>&, const VectorOf<2>&,
                                ShapeFunctions<2>&);
template void fit_at<2>(const MovingLeastSquares<2>&, const VectorOf<2>&, ShapeFunctions<2>&);

}  // namespace supple
