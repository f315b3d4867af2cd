# Three seconds of scene/scene.ron, with a checkpoint in the middle of contact for RUN_restart.
exec(open("Modified_data/record.py").read())

trick.TMM_hexfloat_checkpoint(1)    # decimal numbers would lose bits
trick.checkpoint(1.5)               # RUN_berthing/chkpnt_1.500000
trick.stop(3.0)
