# What diptych-picture is made with; included by its build and by the probe that asks whether that works.
find_package(MPI REQUIRED COMPONENTS C) # Debian's VTK targets name MPI::MPI_C
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersCore
             FiltersGeneral FiltersGeometry FiltersModeling IOHDF IOImage RenderingAnnotation
             RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(X11 REQUIRED)
