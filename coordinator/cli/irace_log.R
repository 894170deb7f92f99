# Writes the log of irace (irace.Rdata, of irace 3 or 4) as CSV tables into a folder:
#
#   Rscript irace_log.R irace.Rdata FOLDER
#
# `swarmsmith import irace.Rdata --into STORE` does this by itself; `swarmsmith import FOLDER --into
# STORE` reads the tables where there is no R. Needs no package, irace neither.

# The last line of the errors is the reason, which swarmsmith passes on.
options(error = function() quit(save = "no", status = 1))
fail <- function(...) {
  message(gsub("[[:space:]]+", " ", paste0(...)))
  quit(save = "no", status = 1)
}

words <- commandArgs(trailingOnly = TRUE)
if (length(words) != 2) fail("two words are wanted: LOG FOLDER")
loaded <- new.env()
names_loaded <- tryCatch(load(words[1], envir = loaded),
                         warning = function(e) fail("this is no file of R's: ", conditionMessage(e)),
                         error = function(e) fail("this is no file of R's: ", conditionMessage(e)))
if (!"iraceResults" %in% names_loaded) fail("this is no log of irace: it has no iraceResults")
log <- loaded$iraceResults
folder <- words[2]

# Numbers keep all their digits; NA becomes an empty cell.
cells <- function(x) {
  text <- if (is.numeric(x)) sprintf("%.17g", x) else as.character(x)
  text[is.na(x)] <- ""
  text
}
short <- function(x) {  # parameters: as irace shows them
  text <- if (is.numeric(x)) sprintf("%.15g", x) else as.character(x)
  text[is.na(x)] <- ""
  text
}
write_table <- function(.file, ...) {
  columns <- data.frame(..., check.names = FALSE, stringsAsFactors = FALSE)
  utils::write.csv(columns, file.path(folder, .file), row.names = FALSE, quote = TRUE)
}
# A column of a matrix or of a data frame; NA where there is none.
column <- function(table, name) {
  if (name %in% colnames(table)) as.vector(if (is.matrix(table)) table[, name] else table[[name]])
  else rep(NA_real_, nrow(table))
}
first <- function(...) {
  for (value in list(...)) if (!is.null(value)) return(value)
  NULL
}

state <- log$state
scenario <- log$scenario
parameters <- first(scenario$parameters, log$parameters)
is_fixed <- first(as.list(parameters)$isFixed, rep(FALSE, length(parameters$names)))

# From irace 4 on the log and the instances are in the state; irace 3 keeps them elsewhere.
runs <- first(state$experiment_log, log$experimentLog)
if (is.null(runs)) fail("the log has no list of runs; was it written by irace 3 or 4?")
pairs <- first(state$instances_log, state$.irace$instancesList, log$instancesList)
if (is.null(pairs)) fail("the log has no list of instances and seeds")
instance <- if ("instanceID" %in% colnames(pairs)) column(pairs, "instanceID") else
  column(pairs, "instance")

# Costs: beside each run where the log has them, else in the matrix of pairs and configurations.
pair <- column(runs, "instance")
configuration <- column(runs, "configuration")
cost <- column(runs, "cost")
if (all(is.na(cost))) {
  cost <- log$experiments[cbind(match(as.character(pair), rownames(log$experiments)),
                                match(as.character(configuration), colnames(log$experiments)))]
}

completed <- first(state$completed, log$completed, "Incomplete")
planned <- first(state$nbIterations, length(log$iterationElites))
restarts <- which(as.logical(log$softRestart))
keys <- c("irace_version", "completed", "seed", "max_experiments", "iterations",
          rep("soft_restart", length(restarts)))
write_table("log.csv", key = keys,
            value = c(as.character(first(log$irace_version, log$irace.version, "")),
                      as.character(completed), cells(first(scenario$seed, state$seed, NA_real_)),
                      cells(first(scenario$maxExperiments, 0)), cells(planned), restarts))
write_table("parameters.csv", name = parameters$names,
            type = unname(unlist(parameters$types[parameters$names])),
            switch = unname(unlist(parameters$switches[parameters$names])))

all <- log$allConfigurations
values <- lapply(parameters$names, function(name) short(column(all, name)))
names(values) <- parameters$names
write_table("configurations.csv", id = cells(all[[".ID."]]), parent = cells(all[[".PARENT."]]),
            as.data.frame(values, check.names = FALSE, stringsAsFactors = FALSE))

testing <- log$testing
tested <- if (is.null(testing)) matrix(numeric(0), 0, 0) else testing$experiments
seeds <- if (is.null(testing)) numeric(0) else as.vector(testing$seeds)
if (length(seeds) != nrow(tested)) seeds <- rep(NA_real_, nrow(tested))
write_table("pairs.csv", kind = c(rep("race", nrow(pairs)), rep("test", nrow(tested))),
            pair = c(seq_len(nrow(pairs)), seq_len(nrow(tested))),
            instance = cells(c(instance, seq_len(nrow(tested)))),
            seed = cells(c(column(pairs, "seed"), seeds)))
write_table("runs.csv", iteration = cells(column(runs, "iteration")), pair = cells(pair),
            configuration = cells(configuration), cost = cells(cost),
            time = cells(column(runs, "time")), bound = cells(column(runs, "bound")))

elites <- log$allElites
lengths <- vapply(elites, length, 0L)
write_table("elites.csv", iteration = rep(seq_along(elites), lengths),
            rank = unlist(lapply(lengths, seq_len)), configuration = cells(unlist(elites)))
write_table("tests.csv",
            pair = rep(seq_len(nrow(tested)), times = ncol(tested)),
            configuration = rep(colnames(tested), each = nrow(tested)),
            cost = cells(as.vector(tested)))
