// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The bytes of a glTF file: buffers, buffer views and accessors, every range checked before it is used.
#include <pellucid/scene/detail/gltf_container.hpp>
#include <pellucid/scene/detail/gltf_uri.hpp>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace pellucid::inline v0_1::detail {

struct GltfBufferView {
    std::size_t buffer = 0;
    std::uint64_t offset = 0, length = 0;  ///< [B]
    std::uint32_t stride = 0;              ///< [B]; 0: tightly packed
};

enum class GltfComponent : std::uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

[[nodiscard]] constexpr std::uint32_t gltf_size(GltfComponent component) noexcept {
    return component == GltfComponent::i8 || component == GltfComponent::u8     ? 1
           : component == GltfComponent::i16 || component == GltfComponent::u16 ? 2
                                                                                : 4;
}

struct GltfAccessor {
    std::string pointer;  ///< where it stands, for errors
    std::string type;     ///< "SCALAR", "VEC3" …
    GltfComponent component = GltfComponent::f32;
    std::uint32_t width = 1;         ///< components an element
    std::uint32_t element_size = 0;  ///< [B], with the padding of matrix columns: the distance of packed elements
    std::uint32_t last_size = 0;     ///< [B] of the last element: without the padding of its last column
    std::uint64_t count = 0;
    bool normalized = false;
    std::size_t view = npos;  ///< npos: all zeros
    std::uint64_t offset = 0;
    std::uint64_t sparse_count = 0;
    std::size_t sparse_index_view = npos, sparse_value_view = npos;
    std::uint64_t sparse_index_offset = 0, sparse_value_offset = 0;
    GltfComponent sparse_index_component = GltfComponent::u32;
    static constexpr std::size_t npos = ~std::size_t{0};
};

/// Invariant after construction: every view lies inside its buffer's declared length, every accessor inside its view,
/// and every buffer that has a source holds at least its declared length.
class GltfData {
public:
    GltfData(const GltfValue& root, const GltfContainer& container, const std::filesystem::path& folder,
             GltfBudget& files) {
        if (root.has("buffers")) read_buffers(root["buffers"], container, folder, files);
        if (root.has("bufferViews")) read_views(root["bufferViews"]);
        if (root.has("accessors")) read_accessors(root["accessors"]);
    }

    [[nodiscard]] const std::vector<GltfAccessor>& accessors() const noexcept { return accessors_; }
    [[nodiscard]] const GltfBufferView& view(std::size_t i) const { return views_[i]; }
    [[nodiscard]] std::uint64_t loaded_bytes() const noexcept { return loaded_; }

    /// The bytes of view `i`; `user` names what wants them, for the error where the buffer has no source.
    [[nodiscard]] std::span<const std::byte> bytes(std::size_t i, const std::string& user) const {
        const GltfBufferView& view = views_[i];
        const auto& buffer = buffers_[view.buffer];
        if (!buffer.present)
            gltf_fail(user + ": its data is in /buffers/" + std::to_string(view.buffer) +
                      ", which has neither a uri nor a BIN chunk");
        return buffer.bytes.subspan(view.offset, view.length);
    }

private:
    struct Buffer {
        std::vector<std::byte> owned;
        std::span<const std::byte> bytes;
        std::uint64_t length = 0;
        bool present = false;
    };

    void read_buffers(const GltfValue& list, const GltfContainer& container, const std::filesystem::path& folder,
                      GltfBudget& files) {
        buffers_.resize(list.size());
        std::map<std::string, std::size_t> known;  // addresses that several buffers share are read once
        for (std::size_t i = 0; i < list.size(); ++i) {
            const GltfValue value = list[i];
            Buffer& buffer = buffers_[i];
            buffer.length = value.integer("byteLength");
            if (value.has("uri")) {
                auto& uri = value["uri"].json().get_ref<std::string&>();
                const auto [first, fresh] = known.try_emplace(is_data_uri(uri) ? std::to_string(i) : "/" + uri, i);
                if (fresh) buffer.owned = read_uri(value["uri"], uri, folder, files);
                buffer.bytes = buffers_[first->second].owned;
                if (fresh) loaded_ += buffer.bytes.size();
                uri = std::string();  // base64 text is large and has been decoded
                buffer.present = true;
            } else if (i == 0 && container.bin) {
                buffer.bytes = *container.bin;
                loaded_ += buffer.bytes.size();
                buffer.present = true;
            }
            if (buffer.present && buffer.bytes.size() < buffer.length)
                value.fail("byteLength is " + std::to_string(buffer.length) + ", its data has " +
                           std::to_string(buffer.bytes.size()) + " bytes");
        }
    }

public:
    /// The content that an address names: a data URI or a file beside the document.
    static std::vector<std::byte> read_uri(const GltfValue& place, const std::string& uri,
                                           const std::filesystem::path& folder, GltfBudget& files) {
        if (is_data_uri(uri)) {
            auto bytes = decode_data_uri(uri);
            if (!bytes) place.fail("is a data URI whose base64 or percent encoding is broken");
            return std::move(*bytes);
        }
        const auto path = resolve_uri(uri, folder);
        if (!path)
            place.fail("is \"" + gltf_printable(uri) +
                       "\", which is no relative path; copy the file beside the document");
        auto bytes = read_file(*path, files.limit - files.used);
        if (!bytes) gltf_fail(place.pointer() + ": " + bytes.error().message, bytes.error().code);
        files.take(bytes->size(), place.pointer(), "the files");
        return std::move(*bytes);
    }

private:
    void read_views(const GltfValue& list) {
        views_.resize(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) {
            const GltfValue value = list[i];
            GltfBufferView& view = views_[i];
            view.buffer = value.integer("buffer");
            view.offset = value.integer("byteOffset");
            view.length = value.integer("byteLength");
            view.stride = static_cast<std::uint32_t>(value.integer("byteStride"));
            const std::uint64_t length = buffers_[view.buffer].length;
            // Each is below 2^53: the sum cannot wrap.
            if (view.offset + view.length > length)
                value.fail("byteOffset " + std::to_string(view.offset) + " + byteLength " +
                           std::to_string(view.length) + " is beyond the " + std::to_string(length) +
                           " bytes of /buffers/" + std::to_string(view.buffer));
            if (view.stride % 4 != 0) value.fail("byteStride " + std::to_string(view.stride) + " is no multiple of 4");
            if (view.stride > view.length)
                value.fail("byteStride " + std::to_string(view.stride) + " exceeds byteLength " +
                           std::to_string(view.length));
        }
    }

    void read_accessors(const GltfValue& list) {
        accessors_.resize(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) read_accessor(list[i], accessors_[i]);
    }

    void read_accessor(const GltfValue& value, GltfAccessor& accessor) const {
        accessor.pointer = value.pointer();
        accessor.type = value.text("type");
        accessor.component = component(value["componentType"]);
        const std::uint32_t size = gltf_size(accessor.component);
        struct Shape {
            const char* type;
            std::uint32_t columns, rows;
        };
        constexpr Shape shapes[] = {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4},
                                    {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};
        const Shape* shape = nullptr;
        for (const Shape& candidate : shapes)
            if (accessor.type == candidate.type) shape = &candidate;
        if (!shape) value["type"].fail("is \"" + gltf_printable(accessor.type) + "\", none of SCALAR to MAT4");
        accessor.width = shape->columns * shape->rows;
        // Columns of matrices start at multiples of four bytes.
        const std::uint32_t column = shape->rows * size;
        accessor.element_size = shape->columns == 1 ? column : shape->columns * ((column + 3) / 4 * 4);
        accessor.last_size = accessor.element_size - (shape->columns == 1 ? 0 : (column + 3) / 4 * 4 - column);
        accessor.count = value.integer("count");
        accessor.normalized = value.boolean("normalized");
        if (accessor.normalized &&
            (accessor.component == GltfComponent::f32 || accessor.component == GltfComponent::u32))
            value["normalized"].fail("is true, which 32-bit components cannot be");
        accessor.offset = value.integer("byteOffset");
        if (value.has("bufferView")) {
            accessor.view = value.integer("bufferView");
            check_range(value, accessor.view, accessor.offset, accessor.count, accessor.element_size,
                        accessor.last_size, size, true);
        } else if (value.has("byteOffset")) {
            value.fail("has a byteOffset but no bufferView");
        }
        if (value.has("sparse")) read_sparse(value["sparse"], accessor);
    }

    void read_sparse(const GltfValue& value, GltfAccessor& accessor) const {
        accessor.sparse_count = value.integer("count");
        if (accessor.sparse_count > accessor.count)
            value["count"].fail("is " + std::to_string(accessor.sparse_count) + ", the accessor has " +
                                std::to_string(accessor.count) + " elements");
        const GltfValue indices = value["indices"], values = value["values"];
        accessor.sparse_index_component = component(indices["componentType"]);
        if (accessor.sparse_index_component == GltfComponent::i16)
            indices["componentType"].fail("is 5122, must be 5121, 5123 or 5125");
        const std::uint32_t size = gltf_size(accessor.sparse_index_component);
        accessor.sparse_index_view = indices.integer("bufferView");
        accessor.sparse_index_offset = indices.integer("byteOffset");
        check_range(indices, accessor.sparse_index_view, accessor.sparse_index_offset, accessor.sparse_count, size,
                    size, size, false);
        accessor.sparse_value_view = values.integer("bufferView");
        accessor.sparse_value_offset = values.integer("byteOffset");
        check_range(values, accessor.sparse_value_view, accessor.sparse_value_offset, accessor.sparse_count,
                    accessor.element_size, accessor.last_size, gltf_size(accessor.component), false);
    }

    static GltfComponent component(const GltfValue& value) {
        const auto number = value.json().get<std::uint64_t>();
        if (number == 5124) value.fail("is 5124, which is no component type");
        return static_cast<GltfComponent>(number);
    }

    /// offset + stride (count - 1) + last <= the view's length, in 64 bits without wrapping; and the alignment that
    /// graphics APIs need.
    void check_range(const GltfValue& value, std::size_t index, std::uint64_t offset, std::uint64_t count,
                     std::uint64_t element, std::uint64_t last, std::uint64_t alignment, bool strided) const {
        const GltfBufferView& view = views_[index];
        const std::uint64_t stride = strided && view.stride != 0 ? view.stride : element;
        const std::string name = "/bufferViews/" + std::to_string(index);
        if (stride < element)
            value.fail("elements have " + std::to_string(element) + " bytes, the byteStride of " + name + " is " +
                       std::to_string(stride));
        if (offset % alignment != 0 || (view.offset + offset) % alignment != 0 || stride % alignment != 0)
            value.fail("byteOffset " + std::to_string(offset) + " in " + name + " is not aligned to components of " +
                       std::to_string(alignment) + " bytes");
        const bool inside = offset <= view.length && last <= view.length - offset &&
                            (count - 1) <= (view.length - offset - last) / stride;
        if (!inside)
            value.fail(std::to_string(count) + " elements of " + std::to_string(element) + " bytes at byteOffset " +
                       std::to_string(offset) + ", " + std::to_string(stride) + " apart, reach beyond the " +
                       std::to_string(view.length) + " bytes of " + name);
    }

    std::vector<Buffer> buffers_;
    std::vector<GltfBufferView> views_;
    std::vector<GltfAccessor> accessors_;
    std::uint64_t loaded_ = 0;
};

/// Random access to an accessor's elements as floats or as unsigned integers, sparse replacements included.
class GltfReader {
public:
    GltfReader(const GltfData& data, const GltfAccessor& accessor) : accessor_(&accessor) {
        if (accessor.view != GltfAccessor::npos) {
            const GltfBufferView& view = data.view(accessor.view);
            base_ = data.bytes(accessor.view, accessor.pointer).data() + accessor.offset;
            stride_ = view.stride != 0 ? view.stride : accessor.element_size;
        }
        if (accessor.sparse_count != 0) read_sparse(data);
    }

    [[nodiscard]] std::uint64_t size() const noexcept { return accessor_->count; }

    /// Component `c` of element `i`: the stored float, or the integer, mapped to [0,1] or [-1,1] where normalised.
    [[nodiscard]] float number(std::uint64_t i, std::uint32_t c) const {
        const std::byte* at = find(i);
        if (!at) return 0.0f;
        const bool scaled = accessor_->normalized;
        switch (accessor_->component) {
            case GltfComponent::i8:
                return signed_number(get<std::int8_t>(at, c), 127.0f, scaled);
            case GltfComponent::u8:
                return static_cast<float>(get<std::uint8_t>(at, c)) / (scaled ? 255.0f : 1.0f);
            case GltfComponent::i16:
                return signed_number(get<std::int16_t>(at, c), 32767.0f, scaled);
            case GltfComponent::u16:
                return static_cast<float>(get<std::uint16_t>(at, c)) / (scaled ? 65535.0f : 1.0f);
            case GltfComponent::u32:
                return static_cast<float>(get<std::uint32_t>(at, c));
            default:
                return get<float>(at, c);
        }
    }
    /// The value of a scalar of an unsigned type.
    [[nodiscard]] std::uint32_t index(std::uint64_t i) const {
        const std::byte* at = find(i);
        return at ? unsigned_value(at, accessor_->component) : 0u;
    }

private:
    template <class T>
    static T get(const std::byte* at, std::uint32_t c) {
        T value;
        std::memcpy(&value, at + std::size_t{c} * sizeof(T), sizeof(T));
        return value;
    }
    static float signed_number(std::int32_t value, float largest, bool scaled) {
        return scaled ? std::max(static_cast<float>(value) / largest, -1.0f) : static_cast<float>(value);
    }
    static std::uint32_t unsigned_value(const std::byte* at, GltfComponent component) {
        const std::uint32_t size = gltf_size(component);
        return size == 1 ? get<std::uint8_t>(at, 0) : size == 2 ? get<std::uint16_t>(at, 0) : get<std::uint32_t>(at, 0);
    }
    void read_sparse(const GltfData& data) {
        const auto& a = *accessor_;
        sparse_indices_ = data.bytes(a.sparse_index_view, a.pointer + "/sparse/indices").data() + a.sparse_index_offset;
        sparse_values_ = data.bytes(a.sparse_value_view, a.pointer + "/sparse/values").data() + a.sparse_value_offset;
        std::uint64_t next = 0;  // the least index that may come
        for (std::uint64_t i = 0; i < a.sparse_count; ++i) {
            const std::uint64_t index = sparse_index(i);
            if (index < next || index >= a.count)
                gltf_fail(a.pointer + "/sparse/indices: value " + std::to_string(i) + " is " + std::to_string(index) +
                          ", must rise and be below the count " + std::to_string(a.count));
            next = index + 1;
        }
    }
    [[nodiscard]] std::uint64_t sparse_index(std::uint64_t i) const {
        return unsigned_value(sparse_indices_ + i * gltf_size(accessor_->sparse_index_component),
                              accessor_->sparse_index_component);
    }
    /// Where element `i` is stored; null: it is zero.
    [[nodiscard]] const std::byte* find(std::uint64_t i) const {
        if (accessor_->sparse_count != 0) {
            std::uint64_t low = 0, high = accessor_->sparse_count;
            while (low < high) {
                const std::uint64_t middle = (low + high) / 2;
                if (sparse_index(middle) < i)
                    low = middle + 1;
                else
                    high = middle;
            }
            if (low < accessor_->sparse_count && sparse_index(low) == i)
                return sparse_values_ + low * accessor_->element_size;
        }
        return base_ ? base_ + i * stride_ : nullptr;
    }

    const GltfAccessor* accessor_;
    const std::byte* base_ = nullptr;
    std::uint64_t stride_ = 0;
    const std::byte* sparse_indices_ = nullptr;
    const std::byte* sparse_values_ = nullptr;
};

}  // namespace pellucid::inline v0_1::detail
