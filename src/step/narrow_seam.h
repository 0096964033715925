// narrow_seam.h - inner edges of a floor made of boxes or hulls.
#ifndef FE_STEP_NARROW_SEAM_H
#define FE_STEP_NARROW_SEAM_H
#include "step/view.h"

// Where static boxes or hulls lie flush, an inner edge or face gives way to the face that is open. Of a pair with a
// static body
void fe__mend_seam(const fe_world *world, const fe__view *v, float margin, float fall, fe__manifold *found);

#endif
