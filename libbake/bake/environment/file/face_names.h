// Words in file names that stand for the faces of a cube, as programs and collections of skies write them.
#pragma once
#include <array>
#include <string>

namespace bake {

/// Ways to name the faces, in the order in which they are tried.
enum class FaceWords {
    axes,        ///< px posx pos-x pos_x positive_x plusx +x x+ xp xpos ...; negative: n, m, neg, minus, -; front+z
    words,       ///< right left up|top|... down|bottom|... front|forward back|rear|...; front is +Z
    id_software, ///< rt lf up dn bk ft, as Quake, Source and Roblox have them; bk is +Z
    short_words, ///< rt lf up dn fr bk; fr is +Z
    letters,     ///< r l u|t d f b
    cardinals,   ///< east west up down north south; north is +Z
    from_zero,   ///< 0 1 2 3 4 5 in the order of CubeFace, after leading zeros or c, f, face, side
    from_one,    ///< 1 2 3 4 5 6, likewise
    count
};

/// The face that a part of a file name stands for, -1 if the part has no word of this kind. Upper and lower case are the
/// same. Blanks, '_', '.', and '-' between words are ignored, as are digits before and after a word (right1).
int face_named(FaceWords kind, const std::string& part);

/// The first word of a kind for a face, in lower case.
std::string word_of(FaceWords kind, int face);

} // namespace bake
