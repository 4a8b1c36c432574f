#include "silhouette/methods/brute_force_packed.h"

#include <bit>
#if defined(__x86_64__)
// gcc 12 warns of registers that its own header leaves undefined on purpose.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#include "silhouette/mesh/face_bits.h"

namespace rimline {

// The loop bodies, inlined into a function for each instruction set.
struct PackedBruteForce::Kernels {
    [[gnu::always_inline]] static inline void make_face_bits(const Planes& planes,
                                                             const HomogeneousPoint& p,
                                                             std::span<std::uint32_t> words) {
        const float* const nx = planes.nx;
        const float* const ny = planes.ny;
        const float* const nz = planes.nz;
        const float* const d = planes.d;
        for (std::size_t w = 0; w < words.size(); ++w) {
            std::uint32_t bits = 0;
            for (std::size_t i = 0; i < 32; ++i) {
                const std::size_t f = w * 32 + i;
                const bool front = (nx[f] * p.x + ny[f] * p.y) + nz[f] * p.z > p.w * d[f];
                bits |= front ? 1u << i : 0u;
            }
            words[w] = bits;
        }
    }

    // Those of 32 edges whose faces' bits differ.
    [[gnu::always_inline]] static inline std::uint32_t compare_faces(const std::uint32_t* face_a,
                                                                     const std::uint32_t* face_b,
                                                                     const std::uint32_t* words) {
        std::uint32_t differ = 0;
        for (std::uint32_t i = 0; i < 32; ++i) {
            const std::uint32_t a = words[face_a[i] / 32] >> (face_a[i] % 32);
            const std::uint32_t b = words[face_b[i] / 32] >> (face_b[i] % 32);
            differ |= ((a ^ b) & 1u) << i;
        }
        return differ;
    }

    static void face_bits_baseline(const Planes& planes, const HomogeneousPoint& p,
                                   std::span<std::uint32_t> words) {
        make_face_bits(planes, p, words);
    }
    static std::uint32_t compare_baseline(const std::uint32_t* a, const std::uint32_t* b,
                                          const std::uint32_t* words) {
        return compare_faces(a, b, words);
    }

#if defined(__x86_64__)
    [[gnu::target("avx2")]] static void face_bits_avx2(const Planes& planes,
                                                       const HomogeneousPoint& p,
                                                       std::span<std::uint32_t> words) {
        make_face_bits(planes, p, words);
    }
    // Intrinsics: gcc compiles the plain loop to single loads, which takes a tenth longer.
    [[gnu::target("avx2")]] static std::uint32_t compare_avx2(const std::uint32_t* face_a,
                                                              const std::uint32_t* face_b,
                                                              const std::uint32_t* words) {
        std::uint32_t differ = 0;
        for (std::uint32_t i = 0; i < 32; i += 8) {
            const __m256i bits =
                _mm256_xor_si256(bits_avx2(face_a + i, words), bits_avx2(face_b + i, words));
            // The bits are lowest; the mask reads the sign.
            const __m256 signs = _mm256_castsi256_ps(_mm256_slli_epi32(bits, 31));
            differ |= static_cast<std::uint32_t>(_mm256_movemask_ps(signs)) << i;
        }
        return differ;
    }
    [[gnu::target("avx2"), gnu::always_inline]] static inline __m256i bits_avx2(
        const std::uint32_t* faces, const std::uint32_t* words) {
        const __m256i f = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(faces));
        const __m256i word =
            _mm256_i32gather_epi32(reinterpret_cast<const int*>(words), _mm256_srli_epi32(f, 5), 4);
        return _mm256_srlv_epi32(word, _mm256_and_si256(f, _mm256_set1_epi32(31)));
    }

    [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")]] static void
    face_bits_avx512(const Planes& planes, const HomogeneousPoint& p,
                     std::span<std::uint32_t> words) {
        make_face_bits(planes, p, words);
    }
    [[gnu::target("avx512f")]] static std::uint32_t compare_avx512(const std::uint32_t* face_a,
                                                                   const std::uint32_t* face_b,
                                                                   const std::uint32_t* words) {
        const __mmask16 low = differ_avx512(face_a, face_b, words);
        const __mmask16 high = differ_avx512(face_a + 16, face_b + 16, words);
        return std::uint32_t{low} | std::uint32_t{high} << 16;
    }
    [[gnu::target("avx512f"), gnu::always_inline]] static inline __mmask16 differ_avx512(
        const std::uint32_t* face_a, const std::uint32_t* face_b, const std::uint32_t* words) {
        const __m512i a = _mm512_loadu_si512(face_a);
        const __m512i b = _mm512_loadu_si512(face_b);
        const __m512i word_a = _mm512_i32gather_epi32(_mm512_srli_epi32(a, 5), words, 4);
        const __m512i word_b = _mm512_i32gather_epi32(_mm512_srli_epi32(b, 5), words, 4);
        // A rotation uses its count modulo 32.
        const __m512i differ =
            _mm512_xor_si512(_mm512_rorv_epi32(word_a, a), _mm512_rorv_epi32(word_b, b));
        return _mm512_test_epi32_mask(differ, _mm512_set1_epi32(1));
    }
#endif
};

PackedBruteForce::PackedBruteForce(const Mesh& mesh)
    : mesh_(&mesh),
      face_kernel_(Kernels::face_bits_baseline),
      edge_kernel_(Kernels::compare_baseline) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        face_kernel_ = Kernels::face_bits_avx512;
        edge_kernel_ = Kernels::compare_avx512;
    } else if (__builtin_cpu_supports("avx2")) {
        face_kernel_ = Kernels::face_bits_avx2;
        edge_kernel_ = Kernels::compare_avx2;
    }
#endif
    const std::size_t padded_faces = std::size_t{face_word_count(mesh.face_count())} * 32;
    nx_.resize(padded_faces);
    ny_.resize(padded_faces);
    nz_.resize(padded_faces);
    d_.resize(padded_faces);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Plane& plane = mesh.plane(FaceId{f});
        nx_[f] = plane.nx;
        ny_[f] = plane.ny;
        nz_[f] = plane.nz;
        d_[f] = plane.d;
    }
    const std::uint32_t two_faced = mesh.edges_of_class(EdgeClass::inconsistent).last;
    const std::size_t padded_edges = (std::size_t{two_faced} + 31) / 32 * 32;
    face_a_.resize(padded_edges);
    face_b_.resize(padded_edges);
    for (std::uint32_t e = 0; e < two_faced; ++e) {
        face_a_[e] = index(mesh.edge(EdgeId{e}).faces[0]);
        face_b_[e] = index(mesh.edge(EdgeId{e}).faces[1]);
    }
}

void PackedBruteForce::face_bits(const HomogeneousPoint& point,
                                 std::vector<std::uint32_t>& words) const {
    words.resize(face_word_count(mesh_->face_count()));
    face_kernel_({nx_.data(), ny_.data(), nz_.data(), d_.data()}, point, words);
}

void PackedBruteForce::silhouette(std::span<const std::uint32_t> words,
                                  std::vector<EdgeId>& edges) const {
    RIMLINE_CHECK(words.size() == face_word_count(mesh_->face_count()));
    edges.clear();
    const std::uint32_t last_regular = mesh_->edges_of_class(EdgeClass::regular).last;
    const std::uint32_t last_two_faced = mesh_->edges_of_class(EdgeClass::inconsistent).last;
    for (std::uint32_t first = 0; first < last_two_faced; first += 32) {
        std::uint32_t on = edge_kernel_(&face_a_[first], &face_b_[first], words.data());
        if (first + 32 > last_regular) {
            // Inconsistent edges are on the silhouette where the bits are equal.
            const std::uint32_t regular = last_regular > first ? last_regular - first : 0;
            on ^= ~0u << regular;
            if (last_two_faced - first < 32) on &= (1u << (last_two_faced - first)) - 1;
        }
        for (; on != 0; on &= on - 1)
            edges.push_back(EdgeId{first + static_cast<std::uint32_t>(std::countr_zero(on))});
    }
    const Mesh::EdgeRange nonmanifold = mesh_->edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e)
        if (is_on_silhouette(*mesh_, EdgeId{e}, words)) edges.push_back(EdgeId{e});
}

}  // namespace rimline
