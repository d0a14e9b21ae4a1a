# Tests and the benchmark, which share the robots that they play with.
get_filename_component(package ${CMAKE_CURRENT_SOURCE_DIR} REALPATH)  # a workspace may only link to it
add_library(${PROJECT_NAME}_testing STATIC EXCLUDE_FROM_ALL test/random_content.cpp test/team.cpp)
target_link_libraries(${PROJECT_NAME}_testing ${PROJECT_NAME})

foreach(name budget clock_offset codec convergence exchange golden hostile options seal sharing store team_udp transport)
  catkin_add_gtest(${PROJECT_NAME}_${name}_test test/${name}_test.cpp)
  target_link_libraries(${PROJECT_NAME}_${name}_test ${PROJECT_NAME}_testing)
  target_compile_definitions(${PROJECT_NAME}_${name}_test PRIVATE PACKAGE_DIRECTORY="${package}")
endforeach()

find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_executable(exchange_bench EXCLUDE_FROM_ALL bench/exchange_bench.cpp)
  target_include_directories(exchange_bench PRIVATE test)
  target_link_libraries(exchange_bench ${PROJECT_NAME}_testing benchmark::benchmark)
  add_dependencies(tests exchange_bench)
endif()
