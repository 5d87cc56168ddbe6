// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/files/contact_output.h>

namespace graupel
{
  VtuPiece
  contact_output(const std::vector<ContactState> &contacts)
  {
    std::vector<dealii::Point<3>> ends;
    // Each value once for each end.
    std::vector<float>                normals, tangentials, overlaps;
    std::vector<std::int32_t>         with_wall;
    std::vector<dealii::Tensor<1, 3>> forces;
    for (const ContactState &contact : contacts)
      {
        // The normal points to the partner, which pushes against it.
        const double normal     = -contact.force * contact.normal;
        const auto   tangential = contact.force + normal * contact.normal;
        ends.insert(ends.end(), {contact.first_center, contact.second_center});
        normals.insert(normals.end(), 2, normal);
        tangentials.insert(tangentials.end(), 2, tangential.norm());
        overlaps.insert(overlaps.end(), 2, contact.overlap);
        with_wall.insert(with_wall.end(), 2, contact.second < 0 ? 1 : 0);
        forces.insert(forces.end(), 2, contact.force);
      }
    VtuPiece piece(VtuPiece::line, ends);
    piece.add("normal_force", normals);
    piece.add("tangential_force", tangentials);
    piece.add("overlap", overlaps);
    piece.add("with_wall", with_wall);
    piece.add_vectors<float>("force", forces);
    return piece;
  }
} // namespace graupel
