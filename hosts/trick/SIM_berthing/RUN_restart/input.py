# The second half of RUN_berthing, to the same bits: run RUN_berthing first.
trick.TMM_hexfloat_checkpoint(1)
# The second folder is that of the recording: it would go on in RUN_berthing otherwise, over the first half.
trick.load_checkpoint("RUN_berthing/chkpnt_1.500000", "RUN_restart")
trick.load_checkpoint_job()         # runs the restart jobs now, before anything else
trick.stop(3.0)
