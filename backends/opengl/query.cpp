// SPDX-License-Identifier: MIT
#include "pellucid/opengl/device.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {

Result<rhi::Queries> Device::make_queries(const rhi::QueriesDesc& desc) {
    PELLUCID_CHECK(enter());
    if (desc.count == 0)
        return Error{Errc::invalid_argument, text("'%s' has 0 queries; it needs at least 1", desc.debug_name)};
    QueriesObject made{.kind = desc.kind, .count = desc.count, .names = std::make_unique<GLuint[]>(desc.count)};
    glCreateQueries(desc.kind == rhi::QueryKind::timestamp ? GL_TIMESTAMP : GL_SAMPLES_PASSED,
                    static_cast<GLsizei>(desc.count), made.names.get());
    for (std::uint32_t i = 0; i < desc.count; ++i) label(GL_QUERY, made.names[i], desc.debug_name);
    return objects_.queries.insert(std::move(made));
}

void Device::destroy(rhi::Queries queries) {
    if (!alive(queries)) return;
    context_->enter();
    const QueriesObject object = objects_.queries.erase(queries);
    glDeleteQueries(static_cast<GLsizei>(object.count), object.names.get());
}

Result<void> Device::results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out) {
    PELLUCID_CHECK(enter());
    const QueriesObject* object = objects_.queries.find(queries);
    if (!object) return Error{Errc::invalid_argument, "results() got a handle of no living queries"};
    if (std::uint64_t{first} + out.size() > object->count)
        return Error{Errc::invalid_argument, text("results() asks for queries %u to %zu of a pool of %u", first,
                                                  first + out.size(), object->count)};
    for (std::size_t i = 0; i < out.size(); ++i) {
        GLuint64 value = 0;
        glGetQueryObjectui64v(object->names[first + i], GL_QUERY_RESULT, &value);
        out[i] = value;
    }
    return {};
}

// OpenGL's queries start over by themselves.
void Commands::reset(rhi::Queries) {}

void Commands::write_timestamp(rhi::Queries queries, std::uint32_t index) {
    context_->enter();
    glQueryCounter(objects_->queries[queries].names[index], GL_TIMESTAMP);
}

void Commands::begin_query(rhi::Queries queries, std::uint32_t index) {
    glBeginQuery(GL_SAMPLES_PASSED, objects_->queries[queries].names[index]);
}

void Commands::end_query(rhi::Queries, std::uint32_t) {
    glEndQuery(GL_SAMPLES_PASSED);
}

}  // namespace pellucid::inline v0_1::opengl
