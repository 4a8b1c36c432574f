#include "silhouette/points/umbrella.h"

namespace rimline {

const char* describe(UndecidedReason reason) noexcept {
    switch (reason) {
        case UndecidedReason::none: return "";
        case UndecidedReason::alone: return "there is no other point";
        case UndecidedReason::coincident:
            return "it is nearer to another point than 2^-50 of the cloud's size";
        case UndecidedReason::isolated: return "none of its neighbors counts it among their own";
        case UndecidedReason::collinear: return "all its neighbors lie on one line with it";
        case UndecidedReason::no_normal: return "no plane through it has neighbors around it";
        case UndecidedReason::outlier: return "it lies on no surface";
        case UndecidedReason::unconfirmed_border:
            return "it sees a border that does not go on through its neighbors";
    }
    return "";
}

}  // namespace rimline
